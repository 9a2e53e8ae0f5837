# RUN: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mil"])                                  # no such landmark
order(2, "B", ["Well", "Barn"])                                 # no road leads there
order(3, "C", ["Well", "Mill"], actions={"Mill": [action("fly", "f1")]})
order(4, "D", ["Well", "Mill"])                                 # this one is driven
order(6, "E", ["Well", "Inn"])                                  # while that one is
order(8, "D", ["Well", "Barn"], update=1, first=0)              # an update has to begin where the base ends
instant(9, "dance", "d1")
order(30, "F", ["Inn", "Well"])                                 # it stands elsewhere
print('{"t": 31, "topic": "order", "message": "no JSON"}')
