# RUN: printf 'seed = 5\n[[event]]\nwhen = { time = 0 }\nobstacle = "crate"\nat = [1.0, 0]\nradius = 0.2\n' > %t/s.toml; kbc sim works.d/works.kb --scenario %t/s.toml
