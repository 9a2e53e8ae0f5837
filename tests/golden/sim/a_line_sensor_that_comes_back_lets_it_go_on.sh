# RUN: printf '[[event]]\nwhen = { road = "LM2.S", metres = 0.5 }\nsensor = "line"\nfault = "dead"\nfor = 10\n' > %t/s.toml; kbc sim ../../../examples/04_simulator/route1.kb --scenario %t/s.toml
