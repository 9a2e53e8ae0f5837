# RUN: kbc import lif %d/layout.json
