"""A host whose odometry counts from far away and has done so for long: far.py METRES RADIANS COMMAND..."""
import json
import subprocess
import sys

metres, radians = map(float, sys.argv[1:3])
mind = subprocess.Popen(sys.argv[3:], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)
for line in sys.stdin:
    said = json.loads(line)
    for field, more in ("odometry_x_m", metres), ("odometry_y_m", metres), ("odometry_turned_rad", radians):
        if field in said:
            said[field] += more
    mind.stdin.write(json.dumps(said) + "\n")
    print(mind.stdout.readline(), end="", flush=True)
mind.stdin.close()
mind.wait()
