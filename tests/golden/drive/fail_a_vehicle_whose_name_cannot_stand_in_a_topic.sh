# RUN: kbc drive orders.d/yard.kb -w --orders mqtt://broker --manufacturer Acme/Sons --serial "#7" --interface "+" < /dev/null
