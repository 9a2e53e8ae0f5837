# RUN: echo '{"features": []}' | kbc import nav2 -
