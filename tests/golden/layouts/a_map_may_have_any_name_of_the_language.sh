# RUN: kbc import nav2 ../../../data/layouts/nav2/sample_graph.geojson --map Südhof --prefix Ö -o %t/m.kb; kbc check %t/m.kb && grep -E '^map|Ö0\.E' %t/m.kb
