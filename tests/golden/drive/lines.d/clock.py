"""A host whose clock counts from 1970, and which is away for ten minutes."""
import json

for t in (0, 0.1, 600.2, 600.3):
    print(json.dumps({"t": 1_700_000_000 + t, "odometry_m_s": 0.5}))
