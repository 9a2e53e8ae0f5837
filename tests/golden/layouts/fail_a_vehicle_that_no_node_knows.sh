# RUN: kbc import lif ../../../data/layouts/lif/08-station-with-two-nodes-restricted-for-different-ve.json --vehicle tugger
