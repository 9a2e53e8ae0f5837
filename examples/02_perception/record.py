#!/usr/bin/env python3
"""Makes drive.readings.csv: what the sensors of a robot read that drives Route1, from what was the case.

`drive.facts.csv` says, five times a second, what was true on the way; this script says what real sensors make of it: noise,
a rate for each sensor, a dead reflectance cell (line[1]), a range finder that stops speaking half-way (range[4]), tags that
are not read every time, and now and then a reading that is no number.

    record.py drive.facts.csv > drive.readings.csv

Seeded: always the same bytes.
"""
import csv
import random
import sys

random.seed(2020)
HEADING = {"In.N": 180, "In.E": 270, "In.S": 0, "In.W": 90}
with open(sys.argv[1], encoding="utf-8") as file:
    rows = list(csv.DictReader(file))
landmarks = [name for name in rows[0] if name.startswith("LM")]


def true(row, fact):
    return float(row.get(fact) or 0) >= 0.5


def noisy(value, spread, low, high):
    return f"{min(high, max(low, random.gauss(value, spread))):.3g}"


def line(i, row):
    return "0" if i == 1 else noisy(0.95 if true(row, "Line") or i == 2 else 0.08, 0.02, 0, 1)


def distance(i, row, n):
    if i == 4 and 2 * n > len(rows):
        return ""
    if random.random() < 0.002:
        return random.choice(["nan", "inf", "9.9"])
    if i == 0 and true(row, "Obst"):
        return noisy(0.15, 0.02, 0, 4)
    if i in (1, 7):
        return noisy(2.0 if true(row, "Safe") else 0.4, 0.02, 0, 4)
    return noisy(0.4 if i in (2, 6) else 2.0, 0.02, 0, 4)


def tag(row):
    seen = [name for name in landmarks if true(row, name)]
    return (seen[0] if random.random() < 0.9 else "") if seen else "-"


def memory(row):
    for fact, text in {"CrossBy.mark": "cross mark", "MoveBy.mark": "move mark", "MoveBy.dist": "move dist"}.items():
        if true(row, fact):
            return text
    return "-"


print("t,Start1,Track.azimuth," + ",".join([f"line[{i}]" for i in range(5)] + [f"range[{i}]" for i in range(8)]) + ",compass,tag,memory")
heading = 180
for n, row in enumerate(rows):
    for fact, angle in HEADING.items():
        if true(row, fact):
            heading = angle
    fields = [row["t"], row["Start1"], row["Track.azimuth"]] + [line(i, row) for i in range(5)]
    fields += [distance(i, row, n) for i in range(8)]
    fields += [f"{random.gauss(heading, 2) % 360:.1f}" if n % 2 == 0 or any(true(row, f) for f in HEADING) else ""]
    fields += [tag(row), memory(row)]
    print(",".join(fields))
