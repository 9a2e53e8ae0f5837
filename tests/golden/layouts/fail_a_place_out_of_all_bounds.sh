# RUN: kbc import lif %d/far.json
