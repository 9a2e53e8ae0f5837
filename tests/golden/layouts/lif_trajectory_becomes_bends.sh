# RUN: kbc import lif %d/curves.json
