# RUN: sed 's/"far"/"back"/' an_order_is_driven_by_its_own_edges.d/plant.json > %t/plant.json
# RUN: cd %t && kbc import lif plant.json 2>&1 | grep -A2 edgeId
