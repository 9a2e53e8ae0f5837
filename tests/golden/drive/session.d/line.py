"""Drives the robot of `kbc sim` badly, in the ways that its first argument names."""
import json
import sys

how = sys.argv[1]
for number, line in enumerate(sys.stdin, 1):
    senses = json.loads(line)
    late = senses["t"] > 2
    if how == "ends" and late:
        sys.exit(3)
    if how == "garbles" and late:
        print("Traceback (most recent call last):", flush=True)
        continue
    if how == "forgets" and late:
        print(json.dumps({"speed": 0.2, "trun": 0}), flush=True)
        continue
    if how == "floods" and late:
        print("x" * 300_000, flush=True)
        continue
    if how == "dies_seeing" and late:
        print(json.dumps({"speed": 0.2, "turn": 0, "strategy": "Stop", "seen": ["Obst"]}), flush=True)
        sys.exit(0)
    if how == "repeats" and late:
        print('{"speed":0,"turn":0}\n' * 2, end="", flush=True)
        continue
    if how == "shouts":
        print(json.dumps({"speed": 0, "turn": 0, "mission": True, "reports": ["\033[2J"]}), flush=True)
        continue
    if how == "tells":
        print(json.dumps({"speed": 0.2, "turn": 0, "mission": 2 < senses["t"] < 8}), flush=True)
        continue
    going = how in ("drives", "ends", "garbles", "forgets", "floods") and senses["t"] > 1
    print(json.dumps({"speed": 0.2 if going else 0, "turn": 0}), flush=True)
