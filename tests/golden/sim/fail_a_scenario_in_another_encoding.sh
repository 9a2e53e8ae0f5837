# RUN: printf 'title = "ok"\nseed = 2 # \374\n' > %t/s.toml; kbc sim ../../../examples/04_simulator/route1.kb --scenario %t/s.toml
