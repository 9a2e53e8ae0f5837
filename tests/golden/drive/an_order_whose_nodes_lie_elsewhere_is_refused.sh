# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
way = ["Well", "Mill"]
order(1, "A", way, at={"Mill": {"x": 6, "y": 0, "mapId": "Floor2"}})
order(2, "B", way, at={"Mill": {"x": 6.3, "y": -0.5, "mapId": "Yard"}})
order(3, "C", way, at={"Mill": {"x": 6, "mapId": "Yard"}})
order(4, "D", way, at={"Mill": {"x": 6.3, "y": -0.5, "mapId": "Yard", "allowedDeviationXY": 0.6}})   # so far off the master lets it be
