# RUN: sed 's/"far"/"back"/' an_order_is_driven_by_its_own_edges.d/plant.json > %t/plant.json
# RUN: sed 's/"far"/"back"/; s/"trajectory".*$/"headerId": 3},/; /"degree"/d' an_order_is_driven_by_its_own_edges.d/order.json > %t/order.json
# RUN: kbc import lif %t/plant.json --order %t/order.json -Wno-layout-adapted | grep -A1 '^route'
# RUN: kbc import lif %t/plant.json --order %t/order.json -o %t/order.kb 2>&1 | grep twice
