# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set sensors.rang.noise=0.1
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set sensors.range.noise=0.1,3
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set event.7.for=20
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set event.first.for=20
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set limit=long
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set seed=1,2
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set limit=20 --set limit=30
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set limit=$(seq -s, 1 1001)
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set limit
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set limit=
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set title=a,a
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set sensors.range.noise=0.01,0.010
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set event.1.for=10,1e1
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --out %t/results --set 'title="a"'
# RUN: kbc sim ../../../examples/04_simulator/route1.kb --set limit=20,30
