"""A host whose robot is driven by hand for a while: by_hand.py FROM_S TO_S [+BUTTON] COMMAND... The button is a switch that is held from a second
before until then."""
import json
import subprocess
import sys

begins, ends, *command = sys.argv[1:]
begins, ends = float(begins), float(ends)
button = command.pop(0)[1:] if command[0].startswith("+") else None
head = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
for line in sys.stdin:
    senses = json.loads(line)
    if senses["t"] > begins:
        senses["vehicle"] = {"mode": "MANUAL" if senses["t"] <= ends else "AUTOMATIC"}
    if button and begins - 1 < senses["t"] <= ends:
        senses["buttons"] = [button]
    head.stdin.write(json.dumps(senses) + "\n")
    head.stdin.flush()
    print(head.stdout.readline().strip(), flush=True)
head.stdin.close()
sys.exit(head.wait())
