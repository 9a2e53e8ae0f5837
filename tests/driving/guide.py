"""A robot whose line sensor measures where the line is, before `kbc drive`: of the darknesses that the simulator tells it makes a place in
millimetres, and whether paint lies across, as magnetic guide sensors and cameras say them.

  guide.py FILE
"""
import json
import subprocess
import sys

LEFT = [0.05, 0.025, 0.0, -0.025, -0.05]   # m: where the simulator's sensors sit


def measured(dark):
    weights = [min(max((one - 0.2) / 0.6, 0.0), 1.0) for one in dark]
    if sum(one > 0.5 for one in dark) >= 4:
        return {"across": True}
    if sum(weights) < 0.5:
        return {}
    return {"left_m": round(sum(w * y for w, y in zip(weights, LEFT)) / sum(weights), 3)}


mind = subprocess.Popen(["kbc", "drive", sys.argv[1], "-w"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
for line in sys.stdin:
    senses = json.loads(line)
    if senses.get("line"):
        senses["line"] = measured(senses["line"])
    mind.stdin.write(json.dumps(senses) + "\n")
    mind.stdin.flush()
    print(mind.stdout.readline(), end="", flush=True)
mind.stdin.close()
mind.wait()
