# RUN: kbc import nav2 ../../../data/layouts/nav2/aws_graph.geojson --map Warehouse -w | diff - ../../../examples/08_plant/warehouse.kb && echo the same
