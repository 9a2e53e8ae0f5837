# RUN: kbc import nav2 ../../../data/layouts/nav2/sample_graph.geojson --map turn_of
