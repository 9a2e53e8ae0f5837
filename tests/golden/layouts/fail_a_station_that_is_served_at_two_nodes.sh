# RUN: kbc import lif ../../../data/layouts/lif/08-station-with-two-nodes-restricted-for-different-ve.json -w --route N1,S01
# RUN: kbc import lif ../../../data/layouts/lif/08-station-with-two-nodes-restricted-for-different-ve.json -w --route N1,S02
