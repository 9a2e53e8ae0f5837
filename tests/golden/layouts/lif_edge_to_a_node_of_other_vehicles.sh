# RUN: kbc import lif %d/plant.json --vehicle A
