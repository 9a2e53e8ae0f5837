# RUN: kbc import nav2 ../../../data/layouts/nav2/sample_graph.geojson
# RUN: kbc import nav2 ../../../data/layouts/nav2/sample_graph.geojson -o %t/a.kb && kbc check %t/a.kb
