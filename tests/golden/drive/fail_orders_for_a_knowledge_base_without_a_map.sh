# RUN: kbc drive orders.d/rules.kb -w --orders orders.d/back.jsonl < /dev/null
