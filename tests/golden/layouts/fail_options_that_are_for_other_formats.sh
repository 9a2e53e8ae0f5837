# RUN: kbc import nav2 ../../../data/layouts/nav2/sample_graph.geojson --vehicle V
# RUN: kbc import fll ../fuzzy/import_an_engine.d/obstacle.fll --by mark
# RUN: kbc import nav2 ../../../data/layouts/nav2/sample_graph.geojson --map 'my map'
# RUN: kbc import nav2 ../../../data/layouts/nav2/sample_graph.geojson --prefix rule
