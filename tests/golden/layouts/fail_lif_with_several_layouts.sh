# RUN: kbc import lif ../../../data/layouts/lif/05-multiple-layouts-in-one-lif.json --layout Layout_Upper_Level
# RUN: kbc import lif ../../../data/layouts/lif/05-multiple-layouts-in-one-lif.json --layout Attic
# RUN: kbc import lif ../../../data/layouts/lif/05-multiple-layouts-in-one-lif.json
