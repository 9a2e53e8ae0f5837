import json
import math

points = [(0, 0)] + [(5 * math.cos(i), 5 * math.sin(i)) for i in range(9)]
features = [{"properties": {"id": i}, "geometry": {"type": "Point", "coordinates": p}} for i, p in enumerate(points)]
features += [{"properties": {"startid": 0, "endid": i}, "geometry": {"type": "LineString", "coordinates": []}} for i in range(1, 10)]
print(json.dumps({"features": features}))
