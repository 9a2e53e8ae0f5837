# RUN: printf '{"layouts": []}' | kbc import lif -
