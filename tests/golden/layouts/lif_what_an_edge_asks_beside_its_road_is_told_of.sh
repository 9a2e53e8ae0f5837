# RUN: kbc import lif %d/plant.json -o %t/a.kb
