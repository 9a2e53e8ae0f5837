# RUN: kbc drive yard.kb --orders orders.jsonl --facts f.csv
