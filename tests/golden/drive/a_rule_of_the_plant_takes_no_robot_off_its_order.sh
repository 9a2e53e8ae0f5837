# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/charging.kb -w --scenario orders.d/low_battery.toml --driver "kbc drive orders.d/charging.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill"])
instant(10, "cancelOrder", "c1")
order(16, "B", ["Well", "Mill"])      # the battery is as it was, but the button is up
