# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds few
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds 9-1
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds 1-9000000000000001
