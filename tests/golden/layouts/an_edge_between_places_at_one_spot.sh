# RUN: kbc import lif %d/plant.json --order %d/order.json | sed -n '/^route/,/^    A/p'
# RUN: kbc import lif %d/plant.json --order %d/unknown.json
# RUN: kbc import lif %d/plant.json -w --route A,B,B2,C | sed -n '/^route/,/^    A/p'
