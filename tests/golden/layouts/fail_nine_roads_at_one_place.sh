# RUN: python3 %d/nine.py | kbc import nav2 -
