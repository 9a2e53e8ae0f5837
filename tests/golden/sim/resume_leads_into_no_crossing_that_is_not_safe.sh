# RUN: printf '[[event]]\nwhen = { time = 1 }\nunsafe = "LM3"\n[[event]]\nwhen = { time = 70 }\npress = "Resume"\n' > %t/s.toml; kbc sim ../../../examples/04_simulator/route1.kb --scenario %t/s.toml
