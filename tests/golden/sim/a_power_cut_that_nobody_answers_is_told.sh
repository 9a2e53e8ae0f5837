# RUN: printf '[[event]]\nwhen = { road = "Dock.E", metres = 0.8 }\npower = "off"\nfor = 5\n' > %t/s.toml; kbc sim works.d/works.kb --scenario %t/s.toml
