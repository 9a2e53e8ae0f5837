# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/ring.kb -w --scenario orders.d/barred.toml --driver "kbc drive orders.d/ring.kb -w --orders %t/orders.jsonl --skill pick=2s --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill", "Barn"])
instant(45, "cancelOrder", "c1")                                # it stands, and has said why: the order is over there
order(50, "B", ["Well", "Shed", "Barn"], actions={"Well": [action("pick", "p1")]})   # the well is behind it
