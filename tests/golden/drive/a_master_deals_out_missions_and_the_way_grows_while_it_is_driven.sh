# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --skill pick=5s --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill", "Barn"], base=2)                                             # to the mill, and perhaps on to the barn
order(8, "A", ["Mill", "Barn"], update=1, first=2, actions={"Barn": [action("pick", "p1", height=1)]})   # on to the barn, before the mill is reached
order(40, "B", ["Barn", "Mill", "Well"])                                                     # and back
