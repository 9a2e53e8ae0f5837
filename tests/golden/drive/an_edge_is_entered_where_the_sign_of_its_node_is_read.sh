# RUN: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl --skill beep=1s" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill"], on={"Mill": [action("beep", "e1", "NONE")]})
