# RUN: cp orders.d/yard.kb %t/order.kb; PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && python3 lines.d/clock.py | kbc drive %t/order.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl > %t/answers && grep -o '"distanceSinceLastNode":[0-9.]*' %t/messages.jsonl
from order import *
order(1_700_000_000, "A", ["Well", "Mill"])
