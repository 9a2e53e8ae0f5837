# RUN: printf '[[event]]\nwhen = { road = "Dock.E", metres = 0.8 }\npower = "off"\n' > %t/s.toml; kbc sim works.d/works.kb --scenario %t/s.toml --expect "stopped: Help.power" --allow missed
