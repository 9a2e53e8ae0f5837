# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/ring.kb -w --scenario orders.d/barred.toml --driver "kbc drive orders.d/ring.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill", "Barn"])
instant(45, "cancelOrder", "c1")
order(75, "B", ["Well", "Mill"])
