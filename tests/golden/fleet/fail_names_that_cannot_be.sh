# RUN: touch %t/NA.toml && kbc fleet ../../../examples/04_simulator/route1.kb --scenario %t/NA.toml --out %t/results
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/plain.toml=nan --out %t/results
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario "../../../examples/04_simulator/plain.toml=two, three" --out %t/results
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/plain.toml= --out %t/results
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/plain.toml=all --out %t/results
