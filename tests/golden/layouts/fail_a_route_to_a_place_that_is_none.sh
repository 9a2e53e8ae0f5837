# RUN: kbc import lif ../../../data/layouts/lif/02-bidirectional-edge.json --route N1,M2
# RUN: kbc import nav2 ../../../data/layouts/nav2/aws_graph.geojson -w --route 8,8
