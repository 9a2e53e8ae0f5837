# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/no_odometry.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill", "Barn"])
instant(30, "cancelOrder", "c1")                                # over where it stands, once it has called for help for 3 s
