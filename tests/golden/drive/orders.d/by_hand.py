"""A host whose robot is driven by hand from 5 s on: by_hand.py COMMAND..."""
import json
import subprocess
import sys

head = subprocess.Popen(sys.argv[1:], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
for line in sys.stdin:
    senses = json.loads(line)
    if senses["t"] > 5:
        senses["vehicle"] = {"mode": "MANUAL"}
    head.stdin.write(json.dumps(senses) + "\n")
    head.stdin.flush()
    print(head.stdout.readline().strip(), flush=True)
head.stdin.close()
sys.exit(head.wait())
