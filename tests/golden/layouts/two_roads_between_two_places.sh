# RUN: kbc import nav2 %d/two_roads.geojson --route 1,2 > %t/a.kb; cat %t/a.kb; kbc check %t/a.kb
