"""The lines of weeks: tags of a neighbour, now and then a line that is no JSON, and at last range finders of which one has gone."""
import json

t = 0.0
for i in range(1200):
    t = round(t + 0.02, 2)
    line = {"t": t, "range_m": [4] * 8, "odometry_m_s": 0}
    if i < 400:
        line["tag"] = {"landmark": f"Far{i}", "exit": "W"}
    if i >= 1000:
        line["range_m"] = [4] * 7
    print(json.dumps(line) if not 400 <= i < 900 or i % 2 == 0 else "{")
