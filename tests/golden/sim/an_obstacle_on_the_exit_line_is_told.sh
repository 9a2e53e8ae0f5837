# RUN: printf '[[event]]\nwhen = { time = 0 }\nobstacle = "crate"\nroad = "Hub.E"\nmetres = 0.2\nradius = 0.12\n' > %t/s.toml; kbc sim works.d/works.kb --scenario %t/s.toml
