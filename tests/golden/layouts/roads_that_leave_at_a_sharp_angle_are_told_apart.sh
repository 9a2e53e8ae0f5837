# RUN: kbc import nav2 ../../../data/layouts/nav2/turtlebot3_graph.geojson --route 1,18,8 -o %t/m.kb && kbc sim %t/m.kb
