#!/usr/bin/env python3
"""The recording beside this script: ten seconds of a robot that approaches a landmark, stops at its line and crosses.

    0.5 s  the operator presses the button; the robot drives west, so it arrives from the east
    2.0 s  the landmark's tag can be read, with gaps
    4.0 s  the stop line lies under it; it stands until something has passed in front of it
    4.2 s  a box is pushed through the crossing: the three front range finders see it, until 5.6 s
    6.0 s  it crosses, which turns it to the north

What is wrong with the sensors, as on real robots: all are noisy and each has a rate of its own (line 10 Hz, range and tag 5 Hz,
compass 2 Hz); line[1] is dead and reads 0; range[4] says nan now and then; range[3] stops speaking at 3 s, so its last reading
grows old; the compass is silent from 7 s to 8 s; one line reading is out of range, one is infinite. No fact depends on that when it
matters. Two faults do change facts: line[4] reads 0 from 5 s to 5.4 s, and range[1] is silent from 4.6 s to 5.2 s, while the box is there.

Seeded: always the same bytes.
"""
import random

random.seed(20)
SENSORS = [f"line[{i}]" for i in range(5)] + [f"range[{i}]" for i in range(8)] + ["compass", "tag"]


def noisy(value, spread, low, high):
    return f"{min(high, max(low, random.gauss(value, spread))):.3g}"


def line(i, t):
    if i == 1:
        return "0"
    on_line = 4.0 <= t < 6.2
    if i == 0 and abs(t - 1.0) < 0.01:
        return "7.5"
    if i == 4 and abs(t - 1.5) < 0.01:
        return "inf"
    seen = noisy(0.95 if on_line or i == 2 else 0.1, 0.02, 0, 1)
    return "0" if i == 4 and 5.0 <= t < 5.4 else seen


def distance(i, t):
    if i == 3 and t >= 3.0:
        return ""
    if i == 4 and random.random() < 0.1:
        return "nan"
    boxed = i in (0, 1, 7) and 4.2 <= t < 5.6
    seen = noisy(0.2 if boxed else 2.5 if i in (0, 1, 7) else 0.6, 0.02, 0, 4)
    return "" if i == 1 and 4.6 <= t < 5.2 else seen


def compass(t):
    if 7.0 <= t < 8.0:
        return "-"
    heading = 270 if t < 6.0 else min(360, 270 + 90 * (t - 6.0) / 0.8)
    return f"{random.gauss(heading, 2) % 360:.1f}"


def tag(t):
    if 2.0 <= t < 5.0 and random.random() < 0.6:
        return "LM5"
    return "-" if abs(t - 5.0) < 0.01 else ""


print("t,Start," + ",".join(SENSORS))
for tick in range(100):
    t = tick / 10
    row = [f"{t:g}", "0.9" if abs(t - 0.5) < 0.01 else "-1"]
    row += [line(i, t) for i in range(5)]
    row += [distance(i, t) if tick % 2 == 0 else "" for i in range(8)]
    row += [compass(t) if tick % 5 == 0 else "", tag(t) if tick % 2 == 0 else ""]
    print(",".join(row))
