# RUN: kbc import nav2 %d/ways.geojson
