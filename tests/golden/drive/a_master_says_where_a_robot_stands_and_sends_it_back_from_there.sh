# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/ring.kb -w --scenario orders.d/midway.toml --driver "kbc drive orders.d/ring.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
def stands_at(t, name, **where):
    instant(t, "initPosition", name, **{"x": 4.45, "y": 0.05, "theta": 0.1, "mapId": "Yard", "lastNodeId": "Well", **where})
stands_at(1, "no-map", mapId="Hall")
stands_at(2, "no-road", y=1.5)
stands_at(3, "across", theta=1.6)
stands_at(4, "elsewhere", lastNodeId="Barn")
stands_at(5, "in-words", x="4.45")
stands_at(6, "here")
order(7, "A", ["Well", "Shed"])
stands_at(8, "too-late")
