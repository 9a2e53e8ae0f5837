# RUN: kbc import lif %d/restricted.json --route Dock,Stop
# RUN: kbc import lif %d/restricted.json --vehicle Truck
# RUN: kbc import lif %d/still.json
# RUN: kbc import lif %d/empty.json
