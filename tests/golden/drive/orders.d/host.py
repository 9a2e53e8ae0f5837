"""A host between a robot and `kbc drive` that has an arm: host.py COMMAND... It says what it is told to pick, and how that goes."""
import json
import subprocess
import sys

head = subprocess.Popen(sys.argv[1:], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
began, words = {}, []
for line in sys.stdin:
    senses = json.loads(line)
    senses["vehicle"] = {"battery": 64.5, "charging": False}
    if words:
        senses["actions"] = words
    head.stdin.write(json.dumps(senses) + "\n")
    head.stdin.flush()
    answer = json.loads(head.stdout.readline())
    words = []
    for todo in answer.get("actions", []):
        if todo["id"] not in began:
            began[todo["id"]] = senses["t"]
            print(f'{todo["type"]} {json.dumps(todo["parameters"])}', file=sys.stderr)
            words.append({"id": todo["id"], "status": "running"})
        elif senses["t"] > began[todo["id"]] + 3:
            done = todo["parameters"]["station"] == "S4"
            words.append({"id": todo["id"], "status": "finished" if done else "failed", "result": "box 17" if done else "nothing is there"})
    print(json.dumps({key: answer[key] for key in ("speed", "turn", "mission", "leg", "goal", "reports")}), flush=True)
head.stdin.close()
head.wait()
