# RUN: for seed in 1 2 5; do kbc sim ../../../examples/07_open_hall/bug.kb --scenario ../../../examples/07_open_hall/aisle.toml --set sensors.range.noise=0.1 --seed $seed | head -1; done
# RUN: kbc sim ../../../examples/07_open_hall/bug.kb --scenario ../../../examples/07_open_hall/aisle.toml --set sensors.range.noise=0.2 --seed 19 | head -1
