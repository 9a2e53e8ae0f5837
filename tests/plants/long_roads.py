#!/usr/bin/env python3
"""Drives missions through chains of crossings made at random: roads of 3 to 30 m with bends near their ends, by line, by walls, by both.

  long_roads.py --kbc build/test/bin/kbc [--count 100] [--seed 1] [--keep DIR]

Nothing goes wrong but what odometry and compass do by themselves. Maps that the simulator cannot build (roads too near to each other) are
left out, at most half of them. Exits with 1 unless all robots arrive, touch nothing and know where they are.
"""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import random
import sys
import tempfile

sys.dont_write_bytecode = True
from plants import ending, in_words, lif, run, tally  # noqa: E402

BENDS = (30, 45, 90, -30, -45, -90)
NO_ROOM = 'cannot be built'
CANNOT = ('KB1302', 'KB1303', 'KB1304', 'KB1306', 'KB1307', 'KB1308', 'KB1309')   # there is no room for it


class Chain:
    """Crossings P0, P1, ...; each but the last has stubs ahead, to the left and to the right, and the next road begins beside one of them."""

    def __init__(self, dice, methods):
        self.dice, self.methods = dice, methods
        self.places, self.ways, self.stops = {'P0': (0.0, 0.0), 'Z': (-3.0, 0.0)}, [], ['P0']
        heading, last = 90.0, dice.randint(2, 4)
        for i in range(1, last + 1):
            heading = self.go_on(i, heading, i == last)
        self.road('Z', [], 'P0')

    def beyond(self, spot, heading, way):
        return (spot[0] + way * math.sin(math.radians(heading)), spot[1] + way * math.cos(math.radians(heading)))

    def go_on(self, i, heading, is_last):
        before, bends, turn = 'P0', [], self.dice.choice((0, 0, 90, -90))
        if i > 1:
            before = f'S{i - 1}_{turn % 360}'
            heading += turn
            self.stops.append(before)
        spot = self.places[before]
        if self.dice.random() < 0.6:
            spot = self.beyond(spot, heading, self.dice.uniform(0.8, 2.0))
            bends.append(spot)
            heading += self.dice.choice(BENDS)
        spot = self.beyond(spot, heading, self.dice.uniform(3.0, 30.0))
        if self.dice.random() < 0.8:
            bends.append(spot)
            heading += self.dice.choice(BENDS)
            spot = self.beyond(spot, heading, self.dice.uniform(0.9, 2.0))
        self.places[f'P{i}'] = spot
        self.road(before, bends, f'P{i}')
        self.stops.append(f'P{i}')
        for turn in () if is_last else (0, 90, -90):
            stub = f'S{i}_{turn % 360}'
            self.places[stub] = self.beyond(spot, heading + turn, 2.5)
            self.road(f'P{i}', [], stub)
        return heading

    def road(self, begin, bends, end):
        line = [self.places[begin], *bends, self.places[end]]
        marked = {'physicalLineGuidedProperty': {}} if self.dice.choice(self.methods) == 'mark' else {}
        for a, b, points in ((begin, end, line), (end, begin, line[::-1])):
            self.ways.append((f'e{len(self.ways)}', a, b, points, marked))


def drive(chosen, methods, number, folder):
    """How the mission ends, and its file."""
    chain = Chain(random.Random(f'{chosen.seed} {number}'), methods)
    file = folder / f'{"_".join(methods)}-{number}.kb'
    plant = file.with_suffix('.json')
    plant.write_text(json.dumps(lif(chain.places, chain.ways)))
    made = run(chosen.kbc, 'import', 'lif', plant, '-w', '--by', 'dist', '--route', ','.join(chain.stops), '-o', file)
    plant.unlink()
    if made.returncode:
        return made.stderr.strip().splitlines()[0], file
    sim = run(chosen.kbc, 'sim', file, '-w', '--seed', number, '--set', 'limit=3000')
    if sim.returncode == 1 and any(code in sim.stderr for code in CANNOT):
        return NO_ROOM, file
    if not sim.stdout:
        return sim.stderr.strip().splitlines()[0], file
    return ending(sim), file


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--kbc', required=True)
    parser.add_argument('--count', type=int, default=100, help='for each way to build the roads')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--keep', type=pathlib.Path, help='a folder for the missions that fail')
    chosen = parser.parse_args()
    good = True
    with tempfile.TemporaryDirectory() as temporary, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        folder = chosen.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for methods in (('mark',), ('dist',), ('mark', 'dist')):
            ends = tally(pool, lambda n: drive(chosen, methods, n, folder), range(chosen.count), ('arrives', NO_ROOM))
            good = good and set(ends) <= {'arrives', NO_ROOM} and 2 * ends['arrives'] >= chosen.count
            print(f'roads by {" and ".join(methods)}: {in_words(ends)}', flush=True)
    sys.exit(0 if good else 1)


main()
