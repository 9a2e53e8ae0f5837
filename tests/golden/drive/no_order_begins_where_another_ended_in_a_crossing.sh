# RUN LONG: PYTHONPATH=orders.d python3 %s > %t/orders.jsonl && kbc sim orders.d/ring.kb -w --scenario orders.d/barred_crossing.toml --driver "kbc drive orders.d/ring.kb -w --orders %t/orders.jsonl --messages %t/messages.jsonl" && python3 orders.d/told.py %t/messages.jsonl | grep -v 'driving, to Mill Barn$\|to Mill Barn$'
from order import *
order(1, "A", ["Well", "Mill", "Barn"])
instant(50, "cancelOrder", "c1")                                # nobody takes the crates away: after a minute the order is over
order(130, "B", ["Well", "Mill"])                               # and the robot would not know how to leave the crossing
