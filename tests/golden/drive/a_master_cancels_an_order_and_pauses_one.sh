# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill", "Barn"])
instant(5, "startPause", "p1")
instant(9, "stopPause", "p2")
instant(12, "cancelOrder", "c1")                                # on its way to the mill: there it stands
order(24, "B", ["Mill", "Well"])                                # and from there it takes the next
instant(26, "factsheetRequest", "f1")
instant(27, "initPosition", "i1", x=0, y=0, theta=0, mapId="Yard", lastNodeId="Inn")
