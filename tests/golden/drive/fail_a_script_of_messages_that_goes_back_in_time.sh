# RUN: kbc drive orders.d/yard.kb -w --orders orders.d/back.jsonl < /dev/null
