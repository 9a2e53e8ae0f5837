# RUN: touch %t/none.jsonl; kbc sim orders.d/yard.kb -w --scenario orders.d/dock.toml --driver "kbc drive orders.d/yard.kb -w --orders %t/none.jsonl # as if from mqtt://broker" | head -1
