# RUN: cp "$(command -v kbc)" %t/kbc && PMI_RANK=0 PMI_SIZE=1 %t/kbc fleet --library ../../../stdlib_rules ../../../examples/04_simulator/route1.kb --seeds 1-2 --out %t/results -q
