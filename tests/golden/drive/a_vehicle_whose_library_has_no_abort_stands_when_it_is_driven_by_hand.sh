# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && cp -r ../../../stdlib_rules %t/lib && sed -i '/^fact Abort/d; s/ and not Abort//; /^rule abort at goal/,/^    then reset/d' %t/lib/std/mission.kb && kbc sim orders.d/yard.kb -w --library %t/lib --scenario orders.d/dock.toml --driver "python3 orders.d/by_hand.py 5 1000 kbc drive orders.d/yard.kb -w --library %t/lib --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl
from order import *
order(1, "A", ["Well", "Mill", "Barn"])
