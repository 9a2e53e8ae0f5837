# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w -q --scenario orders.d/dock.toml --driver "python3 lines.d/broken.py 11 20 kbc drive orders.d/yard.kb -w -q --orders %t/orders.jsonl --messages %t/messages.jsonl" > /dev/null 2>&1; python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill"])
instant(15, "cancelOrder", "c1")       # by then its lines have been refused for a while
order(22, "B", ["Well", "Mill"])
