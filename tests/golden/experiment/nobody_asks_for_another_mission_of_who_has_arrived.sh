# RUN: kbc experiment --out %t/r --seed 101 --show 362 -q && tail -3 %t/r/scenario.toml
