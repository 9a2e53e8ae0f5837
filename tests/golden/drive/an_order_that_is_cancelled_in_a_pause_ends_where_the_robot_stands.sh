# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill", "Barn"])
instant(12, "startPause", "p1")                                 # on its way to the mill
instant(14, "cancelOrder", "c1")                                # it stands: the order is over
instant(16, "stopPause", "p2")
order(18, "B", ["Well", "Mill"])                                # it goes on along the road on which it stands
