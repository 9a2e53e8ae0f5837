# RUN: kbc import lif ../../../data/layouts/lif/12-multiple-edges-between-same-two-nodes-for-differen.json
