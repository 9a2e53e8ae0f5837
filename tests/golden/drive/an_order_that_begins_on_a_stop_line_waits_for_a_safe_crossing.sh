# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/unsafe.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill"])
instant(45, "cancelOrder", "c1")                                # it has come to rest with the stop line just behind its sensors
order(50, "B", ["Well", "Mill"])                                # it stays there until the crossing is safe
