# RUN: kbc import lif ../../../data/layouts/lif/02-bidirectional-edge.json
