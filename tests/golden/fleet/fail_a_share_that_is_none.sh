# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --shard 1of2
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --shard 4/3
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --shard 0/3
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --shard 2/18446744073709551615
