# RUN LONG: kbc import nav2 ../../../data/layouts/nav2/aws_graph.geojson -w --route 31,34 -o %t/mission.kb && kbc sim %t/mission.kb
