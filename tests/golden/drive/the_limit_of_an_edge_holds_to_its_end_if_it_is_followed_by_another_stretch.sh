# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --set limit=90 --scenario orders.d/dock.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --skill wait=2s --visualization 200ms --messages %t/messages.jsonl" | head -1 && python3 orders.d/fastest.py %t/messages.jsonl
from order import *
order(2, "A", ["Well", "Mill", "Barn"], limits={"Mill": 0.1}, actions={"Mill": [action("wait", "w1")]})
