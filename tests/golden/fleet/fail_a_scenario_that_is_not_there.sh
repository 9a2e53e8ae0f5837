# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario nowhere.toml --out %t/results
