# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Inn", "Well", "Mill"])                          # the robot, which knows no place yet, is on the road from the inn to the well
instant(10, "cancelOrder", "c1")
order(12, "B", ["Well", "Mill"])
