# RUN: kbc import nav2 %d/graph.geojson
