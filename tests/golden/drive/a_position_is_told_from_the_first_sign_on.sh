# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --csv %t/truth.csv --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl --visualization 500ms" && python3 orders.d/places.py %t/messages.jsonl %t/truth.csv
from order import *
order(1, "A", ["Well", "Mill", "Barn"])
