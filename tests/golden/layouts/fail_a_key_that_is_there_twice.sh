# RUN: printf '{"layouts": [{"layoutId": "G", "nodes": [{"nodeId": "A", "nodePosition": {"x": 0, "y": 0, "x": 400}}], "edges": []}]}' | kbc import lif -
