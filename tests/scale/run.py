#!/usr/bin/env python3
"""The compiler's work grows with the program, no faster: instructions, counted by callgrind, on cities of 4,000 to 16,000 roads.

  run.py KBC LIBRARY MAKE_MAP

Instructions do not depend on what else the machine does, as times would. Two things are asked:
- a road more takes as many instructions in the largest city as in the smallest. What takes the square of the program shows here, unless it
  is a small thing, such as clearing a bit for each condition: of that a million roads take many seconds, and 16,000 none;
- the analysis, which `-w` leaves out, is a small part of it all. What looks at all rules once more, and slowly, shows here.
docs/large.md has the times for a million roads.
"""
import os
import re
import subprocess
import sys
import tempfile

KBC, LIBRARY, MAKE_MAP = sys.argv[1:4]
ROADS = [4_000, 8_000, 16_000]
MOST_GROWTH = 1.02     # 1.004 when this was written
MOST_ANALYSIS = 0.35   # of what all else takes; 0.22 when this was written


def instructions(*command):
    counted = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *command], capture_output=True, text=True,
                             env={**os.environ, "WAYMARK_LIBRARY": LIBRARY})
    total = re.search(r"refs:\s+([\d,]+)", counted.stderr)
    if counted.returncode != 0 or not total:
        sys.exit(f"{' '.join(command)} under callgrind: exit code {counted.returncode}\n{counted.stdout}{counted.stderr}")
    return int(total.group(1).replace(",", ""))


def main():
    whole, unanalysed = [], []
    with tempfile.TemporaryDirectory() as folder:
        image = os.path.join(folder, "city.kbt")
        for roads in ROADS:
            city = os.path.join(folder, f"city_{roads}.kb")
            with open(city, "w") as out:
                subprocess.run([MAKE_MAP, "--roads", str(roads), "--kind", "city", "--seed", "1"], stdout=out, check=True)
            whole.append(instructions(KBC, "compile", "--emit", "image", city, "-o", image))
            if roads > ROADS[0]:
                unanalysed.append(instructions(KBC, "compile", "-w", "--emit", "image", city, "-o", image))
    per_road = [(more - less) / (b - a) for less, more, a, b in zip(whole, whole[1:], ROADS, ROADS[1:])]
    growth = per_road[-1] / per_road[0]
    analysis = (whole[-1] - whole[-2]) / (unanalysed[1] - unanalysed[0]) - 1
    print(f"instructions for a road more: {', '.join(f'{n:,.0f}' for n in per_road)}; {growth:.3f} times as many in the larger cities (at most {MOST_GROWTH})")
    print(f"the analysis takes {analysis:.2f} of what all else takes (at most {MOST_ANALYSIS})")
    sys.exit(0 if growth <= MOST_GROWTH and analysis <= MOST_ANALYSIS else 1)


main()
