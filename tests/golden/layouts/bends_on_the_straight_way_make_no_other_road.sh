# RUN: kbc import nav2 %d/graph.geojson | sed -n '/landmark/d;/map/,/}/p'
