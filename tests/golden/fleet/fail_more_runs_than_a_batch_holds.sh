# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds 1-10000001
