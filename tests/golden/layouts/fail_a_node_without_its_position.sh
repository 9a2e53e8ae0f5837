# RUN: kbc import lif %d/nodes.json
