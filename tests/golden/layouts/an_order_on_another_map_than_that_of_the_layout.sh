# RUN: kbc import lif %d/plant.json --order %d/order.json | grep -A 1 '^route'
