"""A host that is away for a second while the robot drives; then the red button is pressed, or told as a fact."""
import json
import sys

for i in range(1, 180):
    t = 0.02 * i + (1.0 if i > 120 else 0.0)
    line = {"t": round(t, 2), "line": [0, 0, 1, 0, 0], "range_m": [4] * 8, "compass_rad": 0.0, "odometry_m_s": 0.0, "odometry_turned_rad": 0.0, "tag": {}}
    if 50 < i < 60:
        line["buttons"] = ["Go"]
    if i >= 131 and sys.argv[1] == "button":
        line["buttons"] = ["Abort"]
    if i >= 131 and sys.argv[1] == "fact":
        line["facts"] = {"Abort": 0.9}
    print(json.dumps(line))
