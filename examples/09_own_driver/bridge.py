"""A real robot's loop, with `kbc drive` as its head.

    kbc sim track.kb --driver "python3 bridge.py track.kb"

`Mind` is the part to keep: it needs no library, and nothing of it knows the robot. `SimulatedRobot` is the part to write anew for a
robot of one's own; ros2_node.py has what stands in its place in ROS 2.
"""
import json
import math
import os
import select
import subprocess
import sys
import time

OUT_OF_RANGE_M = 100.0   # nothing is there, for a robot of any size
LONGEST_WAIT_S = 0.2     # for an answer
FIRST_WAIT_S = 30.0      # for the first one, which comes when the knowledge base is compiled
MOST_OWED = 50           # answers: a second of silence


class MindGone(Exception):
    """`kbc drive` has ended, or says nothing any more."""


class Mind:
    """`kbc drive FILE ...` as a process: senses in, wheels out."""

    def __init__(self, *arguments):
        self.process = subprocess.Popen(["kbc", "drive", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
        self.wait_s = FIRST_WAIT_S
        self.owed = 0          # lines that are not answered yet
        self.heard = b""       # and not read

    def step(self, senses):
        """The answer to one line of senses. None if it does not come in time: then the robot has to stand, and that answer is passed over
        when it comes. Raises MindGone."""
        if self.owed >= MOST_OWED:
            raise MindGone
        try:
            self.process.stdin.write(json.dumps(known(senses)).encode() + b"\n")
        except BrokenPipeError:
            raise MindGone from None
        self.owed += 1
        end = time.monotonic() + self.wait_s
        while self.owed > 0:
            line = self.read_line(end)
            if line is None:
                return None
            self.owed -= 1
        self.wait_s = LONGEST_WAIT_S
        return json.loads(line)

    def read_line(self, end):
        while b"\n" not in self.heard:
            ready, _, _ = select.select([self.process.stdout], [], [], max(0.0, end - time.monotonic()))
            if not ready:
                return None
            came = os.read(self.process.stdout.fileno(), 1 << 16)
            if not came:
                raise MindGone
            self.heard += came
        line, _, self.heard = self.heard.partition(b"\n")
        return line

    def close(self):
        self.process.stdin.close()
        return self.process.wait()


def known(value):
    """The same with None for what is no number, or infinite: JSON has no word for it, and a line with one is refused as a whole."""
    if isinstance(value, dict):
        return {key: known(part) for key, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [known(part) for part in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def eight_ranges(ranges, angle_min, angle_increment, range_min=0.0, range_max=math.inf):
    """The nearest reading within 12 degrees of each of eight directions, of a scan that begins at `angle_min` (ahead is 0, left is
    positive; metres from the robot's centre): what `range_m` wants. Infinite: nothing was seen; -infinite: something too near to be measured.
    Any other reading outside of `range_min` to `range_max` is none: many scanners say 0.0 for a ray that did not come back. A direction without
    a reading is unknown, and not free."""
    eight = []
    for i in range(8):
        seen, looked = OUT_OF_RANGE_M, False
        for k, range_m in enumerate(ranges):
            off = math.remainder(angle_min + k * angle_increment - i * math.pi / 4, 2 * math.pi)
            if abs(off) > 0.21 or math.isnan(range_m) or (math.isfinite(range_m) and not range_min <= range_m <= range_max):
                continue
            looked = True
            seen = min(seen, max(range_m, range_min))
        eight.append(seen if looked else None)
    return eight


def yaw(x, y, z, w):
    """Counter-clockwise from the x axis, of a quaternion. None if it is none: who knows no orientation often says four zeros."""
    if not abs(x * x + y * y + z * z + w * w - 1) < 0.1:
        return None
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


class SimulatedRobot:
    """The robot of `kbc sim --driver`. Its sensors speak the language of `kbc drive` already."""

    def senses(self):
        line = sys.stdin.readline()
        return json.loads(line) if line else None

    def drive(self, answer):
        print(json.dumps(answer), flush=True)


STAND = {"speed": 0, "turn": 0}


def main():
    robot, mind, told = SimulatedRobot(), Mind(*sys.argv[1:]), []
    while (senses := robot.senses()) is not None:
        try:
            answer = mind.step(senses) or STAND
        except MindGone:
            robot.drive(STAND)
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
