# RUN: printf '{"layouts": [\n  {"layoutId": 07}]}' | kbc import lif -
# RUN: printf '{"layouts": [' | kbc import lif -
# RUN: printf '' | kbc import nav2 -
# RUN: python3 -c 'print("[" * 100)' | kbc import nav2 -
