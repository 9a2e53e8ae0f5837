# RUN: kbc import lif an_order_is_driven_by_its_own_edges.d/plant.json --order %d/order.json | grep -A 2 "^# The order"
