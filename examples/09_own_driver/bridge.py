"""A real robot's loop, with `kbc drive` as its head.

    kbc sim track.kb --driver "python3 bridge.py track.kb"

`Mind` is the part to keep: it needs no library, and nothing of it knows the robot. `SimulatedRobot` is the part to write anew for a
robot of one's own; what a ROS 2 node has in its place stands beside each method.
"""
import json
import math
import select
import subprocess
import sys

OUT_OF_RANGE_M = 4.0
LONGEST_WAIT_S = 0.2     # for an answer; the first one comes when the knowledge base is compiled
FIRST_WAIT_S = 30.0


class Mind:
    """`kbc drive FILE ...` as a process: senses in, wheels out."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen(["kbc", "drive", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.wait_s = FIRST_WAIT_S

    def step(self, senses):
        """The answer to one line of senses; None if there is none in time, or no more: then the robot has to stand."""
        try:
            self.process.stdin.write(json.dumps(senses).encode() + b"\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            return None
        ready, _, _ = select.select([self.process.stdout], [], [], self.wait_s)
        self.wait_s = LONGEST_WAIT_S
        line = self.process.stdout.readline() if ready else b""
        return json.loads(line) if line else None

    def close(self):
        self.process.stdin.close()
        return self.process.wait()


def eight_ranges(ranges, angle_min, angle_increment):
    """The nearest reading within 12 degrees of each of eight directions, of a scan that begins at `angle_min` (ahead is 0, left is
    positive; metres from the robot's centre): what `range_m` wants. In ROS 2: eight_ranges(scan.ranges, scan.angle_min, scan.angle_increment)."""
    eight = []
    for i in range(8):
        seen, looked = OUT_OF_RANGE_M, False
        for k, range_m in enumerate(ranges):
            off = math.remainder(angle_min + k * angle_increment - i * math.pi / 4, 2 * math.pi)
            if abs(off) > 0.21 or math.isnan(range_m):
                continue
            looked = True
            seen = min(seen, max(range_m, 0.0))          # inf, nothing seen, stays 4
        eight.append(seen if looked else None)
    return eight


def yaw(x, y, z, w):
    """Counter-clockwise from the x axis, of a quaternion. In ROS 2: of odom.pose.pose.orientation, or of the IMU's."""
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


class SimulatedRobot:
    """The robot of `kbc sim --driver`. Its sensors speak the language of `kbc drive` already."""

    def senses(self):
        # In ROS 2: what the subscriptions heard last, in a timer of 50 Hz. A message that is older than 0.5 s is left out, as its
        # sensor is silent. Say {"t": self.get_clock().now().nanoseconds / 1e9, "range_m": eight_ranges(...), "compass_rad": yaw(...), ...}.
        line = sys.stdin.readline()
        return json.loads(line) if line else None

    def drive(self, answer):
        # In ROS 2: twist.linear.x, twist.angular.z = answer["speed"], answer["turn"]; publisher.publish(twist). The base must stop
        # by itself when it has heard nothing for 0.2 s.
        print(json.dumps(answer), flush=True)


def main():
    robot, mind, told = SimulatedRobot(), Mind(*sys.argv[1:]), []
    while (senses := robot.senses()) is not None:
        answer = mind.step(senses)
        if answer is None:
            robot.drive({"speed": 0, "turn": 0})
            print("kbc drive does not answer: the robot stands", file=sys.stderr)
            break
        if "error" in answer:
            print(answer["error"]["message"], file=sys.stderr)      # its wheels are 0 already
        if answer.get("reports", told) != told:
            told = answer["reports"]
            print("reports:", ", ".join(told) or "none any more", file=sys.stderr)
        robot.drive(answer)
    return mind.close()


if __name__ == "__main__":
    sys.exit(main())
