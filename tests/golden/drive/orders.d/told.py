"""What a vehicle has told its master, a line for each state, errors when they are new: told.py MESSAGES."""
import json
import sys

errors = []
for line in open(sys.argv[1], encoding="utf-8"):
    said = json.loads(line)
    message = said["message"]
    if said["from"] == "master" or said["topic"] != "state":
        if isinstance(message, str):
            print(f'{said["t"]:6.2f} {said["from"]}: {said["topic"]} {message!r}')
            continue
        what = message.get("connectionState") or " ".join([message.get("orderId", "")] + [a["actionType"] for a in message.get("actions", [])]).strip()
        print(f'{said["t"]:6.2f} {said["from"]}: {said["topic"]} {what}'.rstrip())
        continue
    words = [f'{message["orderId"]}/{message["orderUpdateId"]}' if message["orderId"] else "no order", f'at {message["lastNodeId"] or "?"}']
    words += [word for word in ("driving", "paused") if message.get(word)]
    words += ["to " + " ".join(n["nodeId"] if n["released"] else f'({n["nodeId"]})' for n in message["nodeStates"])] if message["nodeStates"] else []
    words += ["wants more base"] if message.get("newBaseRequest") else []
    words += [f'{a["actionId"]} {a["actionStatus"]}' for a in message["actionStates"]]
    words += [f'{e["errorLevel"]} {e["errorType"]}: {e.get("errorDescription", "")}' for e in message["errors"] if e not in errors]
    words += [i["infoType"] for i in message["information"] if i["infoType"] == "standsAtStopLine"]
    errors = message["errors"]
    print(f'{said["t"]:6.2f} ' + ", ".join(words))
