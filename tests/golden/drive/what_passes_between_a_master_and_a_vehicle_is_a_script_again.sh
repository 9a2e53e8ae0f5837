# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && for orders in orders first; do kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/$orders.jsonl --messages %t/messages.jsonl" | head -1; cmp %t/first.jsonl %t/messages.jsonl 2> /dev/null && echo the same; mv %t/messages.jsonl %t/first.jsonl; done
from order import *
order(1, "A", ["Well", "Mill"], base=1)
order(3, "A", ["Well", "Mill"], update=1)
