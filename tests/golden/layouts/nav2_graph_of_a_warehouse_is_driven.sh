# RUN LONG: kbc import nav2 ../../../data/layouts/nav2/aws_graph.geojson --route 0,9,3 -o %t/mission.kb
# RUN: kbc check %t/mission.kb && kbc sim %t/mission.kb
