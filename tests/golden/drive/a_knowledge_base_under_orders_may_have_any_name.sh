# RUN LONG: cp orders.d/yard.kb '%t/the "yard".kb' && PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "kbc drive '%t/the \"yard\".kb' -w --orders %t/orders.jsonl --messages %t/messages.jsonl" | head -1
from order import *
order(1, "A", ["Well", "Mill"])
