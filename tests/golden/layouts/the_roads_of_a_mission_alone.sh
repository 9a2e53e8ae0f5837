# RUN: kbc import nav2 ../../../data/layouts/nav2/aws_graph.geojson -w --route 0,3 --trim > %t/a.kb; sed -n '/^map/,/^control/p' %t/a.kb; kbc check %t/a.kb && kbc sim %t/a.kb
# RUN: kbc import lif an_order_is_driven_by_its_own_edges.d/plant.json -w --order an_order_of_3_0_does_not_name_the_ends_of_its_edges.d/order.json --trim | sed -n '/^map/,/^route/p'
