# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds 1-20 --shard 2/3 -q && kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --seeds 1-20 --merge
