# RUN: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --set event.0.for=3
# RUN: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --set sensors.range.noise=3
# RUN: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --set limit=20,20
