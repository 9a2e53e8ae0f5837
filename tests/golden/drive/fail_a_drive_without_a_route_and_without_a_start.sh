# RUN: kbc sim orders.d/yard.kb -w < /dev/null; kbc sim orders.d/yard.kb -w --driver "kbc drive orders.d/yard.kb" < /dev/null
