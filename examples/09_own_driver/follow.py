"""Follows the line from the button `Go` to the tag of the mill: a program of one's own at the wheel of the simulated robot.

    kbc sim track.kb --driver "python3 follow.py"
"""
import json
import sys

going = False
for line in sys.stdin:                                    # a line each 20 ms: what the sensors say
    senses = json.loads(line)
    if "Go" in senses.get("buttons", []):
        going = True
    if (senses.get("tag") or {}).get("landmark") == "Mill":
        going = False
    dark = senses.get("line", [0, 0, 0, 0, 0])            # 0 bright to 1 dark, the first at the left
    left = sum(weight * d for weight, d in zip((2, 1, 0, -1, -2), dark)) / max(sum(dark), 0.1)
    on_stop_line = sum(dark) > 3
    turn = 0 if on_stop_line else 1.5 * left
    print(json.dumps({"speed": 0.25 if going else 0, "turn": turn if going else 0}), flush=True)
