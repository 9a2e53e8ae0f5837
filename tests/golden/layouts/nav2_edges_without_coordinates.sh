# RUN: kbc import nav2 %d/editor.geojson
