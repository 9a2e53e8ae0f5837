"""A robot that stands, and whose compass is heard from the third second on: it faces 2 rad all the time."""
import json

for i in range(1, 260):
    line = {"t": round(0.02 * i, 2), "line": [0, 0, 1, 0, 0], "range_m": [4, 4, .3, 4, 4, 4, .3, 4], "odometry_m_s": 0.0, "odometry_turned_rad": 0.0, "tag": {}}
    if i > 150:
        line["compass_rad"] = 2.0
    if 50 < i < 60:
        line["buttons"] = ["Go"]
    print(json.dumps(line))
