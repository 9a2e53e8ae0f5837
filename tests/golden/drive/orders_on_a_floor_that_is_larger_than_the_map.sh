# RUN: : > %t/none.jsonl; kbc drive orders.d/short.kb --orders %t/none.jsonl < /dev/null
# RUN: kbc drive orders.d/short.kb --orders %t/none.jsonl --scale 2.7 < /dev/null && echo as it was asked
# RUN: kbc drive orders.d/yard.kb --orders %t/none.jsonl < /dev/null && echo nothing to say
