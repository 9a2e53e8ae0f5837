# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/switch.kb -w --scenario orders.d/carried.toml --driver "python3 orders.d/by_hand.py 11 16 +Pause kbc drive orders.d/switch.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill", "Barn"])
order(14, "B", ["Mill", "Barn"])                                # not while it is in somebody's hands
order(22, "B", ["Barn", "Mill"])                                # there it was set down; until then its own switch held it
