# RUN: kbc drive orders.d/yard.kb -w --orders /dev/null --skill pick,wait=5s,pick=2s < /dev/null; kbc drive orders.d/yard.kb -w --orders /dev/null --skill pick,=5s < /dev/null
