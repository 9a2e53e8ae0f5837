"""A host of whose range finders one fails for a while, so that its lines are refused: broken.py FROM TO COMMAND..."""
import json
import subprocess
import sys

begin, end = map(float, sys.argv[1:3])
mind = subprocess.Popen(sys.argv[3:], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
for line in sys.stdin:
    said = json.loads(line)
    if begin <= said["t"] < end:
        said["range_m"] = said["range_m"][1:]
    mind.stdin.write(json.dumps(said) + "\n")
    print(mind.stdout.readline(), end="", flush=True)
mind.stdin.close()
mind.wait()
