# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds 1-20 --shard 3/3
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds 1-20 --shard 1/3
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds 1-20 --shard 2/3
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds 1-20 --merge -q > %t/merged && kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds 1-20 --shard 2/3
