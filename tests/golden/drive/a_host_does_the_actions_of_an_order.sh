# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "python3 orders.d/host.py kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --skill pick,blink=2s --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill"], actions={"Well": [action("blink", "b1", "NONE")], "Mill": [action("pick", "p1", station="S4", height=1.25), action("pick", "p2", station="S5")]})
