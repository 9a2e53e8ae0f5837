# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/ring.kb -w --set limit=160 --scenario orders.d/dock.toml --driver "kbc drive orders.d/ring.kb -w --orders %t/orders.jsonl --skill pick=2s --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
# Each time before the robot comes to the end of what is released. What it has passed is no part of its mission any more, and nothing of that shows.
from order import *
ring = ["Well", "Mill", "Barn", "Shed"]
way = [ring[i % 4] for i in range(11)]
order(1, "A", way[:3])
for i in range(2, 10):
    order(12 + 12 * (i - 2), "A", way[i:i + 2], update=i - 1, first=2 * i, actions={"Shed": [action("pick", f"p{i}")]} if i == 6 else {})
