"""The fastest that a vehicle in the yard has said it drives, to 0.05 m/s, from the well to the mill and behind it: fastest.py MESSAGES."""
import json
import sys

roads = {}
for line in open(sys.argv[1], encoding="utf-8"):
    message = json.loads(line)
    if message["topic"] != "visualization" or "agvPosition" not in message["message"]:
        continue
    at, velocity = message["message"]["agvPosition"], message["message"]["velocity"]
    if at["x"] < 3.4:
        continue
    road = "to the mill and through its crossing" if at["y"] == 0 else "to the barn"
    roads[road] = max(roads.get(road, 0), velocity["vx"])
for road, speed in roads.items():
    print(f"{road}: {round(speed * 20) / 20:.2f} m/s")
