# RUN: kbc import lif %d/plant.json
