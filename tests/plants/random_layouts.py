#!/usr/bin/env python3
"""Random ways over random places, and orders along them: the roads that `kbc import` makes lie where the ways do and lead as they do, no
two on the same ground, all of the ways is covered, and an order's route leads over the ground of its edges.

  random_layouts.py --kbc build/test/bin/kbc [--count 200] [--seed 1] [--keep DIR]

A way that comes back to a place is driven without the loop, which kbc tells; of such layouts only the roads are looked at. Of all at
least half must be looked at in full.
"""
import argparse
import itertools
import json
import math
import pathlib
import random
import re
import sys
import tempfile

sys.dont_write_bytecode = True
from plants import lif, run  # noqa: E402

OVER = 0.16       # metres: a road that runs over a place leads there, to 15 cm
STEP = 0.05
SAME = 0.0015     # roads that lie on each other
NOISE = 0.0003    # of a curve back, beside the one there
PLACE = re.compile(r'landmark (\w+)\s+at \(([-\d.e]+), ([-\d.e]+)\)')
ROAD = re.compile(r'road (\w+)\.(\w+)\s+(--|->) (\w+)\.(\w+)\s+by mark(.*)')
POINT = re.compile(r'\(([-\d.e]+), ([-\d.e]+)\)')


# ---- lines, as lists of points

def distance_to_piece(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    share = max(0.0, min(1.0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square)) if square else 0.0
    return math.hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy)


def points_on(line):
    for a, b in zip(line, line[1:]):
        steps = max(1, int(math.dist(a, b) / STEP))
        yield from ((a[0] + (b[0] - a[0]) * i / steps, a[1] + (b[1] - a[1]) * i / steps) for i in range(steps + 1))


def lies_on(line, others, within=OVER):
    """Whether each point of a line is near to one of the others."""
    pieces = [piece for other in others for piece in zip(other, other[1:])]
    return all(any(distance_to_piece(p, a, b) < within for a, b in pieces) for p in points_on(line))


def leads_along(line, others):
    """Whether each piece of a line leads in the direction of one of the others, where that lies on it."""
    for p, q in zip(line, line[1:]):
        middle = ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)
        near = (piece for other in others for piece in zip(other, other[1:]) if distance_to_piece(middle, *piece) < OVER)
        if math.dist(p, q) > 4 * OVER and not any((q[0] - p[0]) * (b[0] - a[0]) + (q[1] - p[1]) * (b[1] - a[1]) > 0.0 for a, b in near):
            return False
    return True


def length(line):
    return sum(math.dist(a, b) for a, b in zip(line, line[1:]))


# ---- layouts

class Plant:
    """Places on a grid, some at one spot, and edges along a random walk, some of them back along others."""

    def __init__(self, dice):
        self.dice = dice
        self.places = [self.spot() for _ in range(dice.randint(3, 7))]
        self.lines, self.ends, self.walk = [], [], []
        at = dice.randrange(len(self.places))
        for _ in range(dice.randint(1, 6)):
            edge = self.edge_from(at)
            self.walk.append(edge)
            at = self.ends[edge][1]

    def spot(self):
        return (2.0 * self.dice.randint(0, 8), 2.0 * self.dice.randint(0, 8))

    def edge_from(self, at):
        known = [edge for edge, (begin, _) in enumerate(self.ends) if begin == at]
        if known and self.dice.random() < 0.3:
            return self.dice.choice(known)
        here = [edge for edge, (_, end) in enumerate(self.ends) if end == at]
        if here and self.dice.random() < 0.3:
            back = self.dice.choice(here)
            end, line = self.ends[back][0], self.shaken(self.lines[back][::-1])
        else:
            end = self.dice.choice([place for place in range(len(self.places)) if place != at])
            bends = [self.dice.choice([self.spot(), self.spot(), self.dice.choice(self.places)]) for _ in range(self.dice.randint(0, 4))]
            line = [self.places[at], *bends, self.places[end]]
        self.lines.append(line)
        self.ends.append((at, end))
        return len(self.ends) - 1

    def shaken(self, line):
        """The same curve as another tool writes it: with one point more, and not quite there."""
        piece = self.dice.randrange(len(line) - 1)
        (ax, ay), (bx, by) = line[piece:piece + 2]
        line = [*line[:piece + 1], ((ax + bx) / 2, (ay + by) / 2), *line[piece + 1:]]
        shift = lambda m: m + self.dice.uniform(-NOISE, NOISE)
        return [line[0], *((shift(x), shift(y)) for x, y in line[1:-1]), line[-1]]

    def layout(self):
        places = {f'P{i}': spot for i, spot in enumerate(self.places)}
        ways = [(f'e{i}', f'P{begin}', f'P{end}', line, {}) for i, ((begin, end), line) in enumerate(zip(self.ends, self.lines))]
        return lif(places, ways)

    def order(self):
        stops = [self.ends[self.walk[0]][0], *(self.ends[edge][1] for edge in self.walk)]
        nodes = [{'nodeId': f'P{place}', 'sequenceId': 2 * i, 'released': True} for i, place in enumerate(stops)]
        edges = [{'edgeId': f'e{edge}', 'sequenceId': 2 * i + 1, 'released': True} for i, edge in enumerate(self.walk)]
        return {'orderId': 'o', 'orderUpdateId': 0, 'nodes': nodes, 'edges': edges}


# ---- what kbc makes of them

class Map:
    def __init__(self, text):
        spots = {name: (float(x), float(y)) for name, x, y in PLACE.findall(text)}
        self.roads, self.driven_lines, self.exits = [], [], {}
        for begin, exit_, arrow, end, approach, through in ROAD.findall(text):
            line = [spots[begin], *((float(x), float(y)) for x, y in POINT.findall(through)), spots[end]]
            self.roads.append(line)
            self.driven_lines += [line, line[::-1]] if arrow == '--' else [line]
            self.exits.setdefault((begin, end), {})[exit_] = line
            if arrow == '--':
                self.exits.setdefault((end, begin), {})[approach] = line[::-1]
        self.route = re.search(r'\nroute Mission.*\n    (.*)', text)[1].split(' -> ')

    def driven(self):
        """The ground of the route; nothing if it does not say by which road."""
        line = []
        for here, there in zip(self.route, self.route[1:]):
            name, _, side = here.partition('.')
            roads = self.exits.get((name, there.partition('.')[0]), {})
            chosen = [roads[side]] if side in roads else [] if side else list(roads.values())
            if len(chosen) != 1:
                return None
            line += chosen[0]
        return line


def leaves_out(messages):
    return 'loop' in messages or 'ends where it begins' in messages or 'nothing to drive' in messages


def same_ground(a, b):
    return abs(length(a) - length(b)) < 0.01 and lies_on(a, [b], SAME) and lies_on(b, [a], SAME)


def fault_of(plant, text, messages):
    """What is wrong with the map of a plant, in words."""
    made = Map(text)
    loops = leaves_out(messages)
    if any({a[0], a[-1]} == {b[0], b[-1]} and same_ground(a, b) for a, b in itertools.combinations(made.roads, 2)):
        return 'two roads on the same ground'
    if not all(leads_along(line, plant.lines) for line in made.driven_lines):
        return 'a road that can be driven where no way leads'
    if not all(lies_on(road, plant.lines) for road in made.roads):
        return 'a road where no way is'
    if not loops and not all(lies_on(line, made.roads) for line in plant.lines):
        return 'a way that no road covers'
    driven, ordered = made.driven(), [point for edge in plant.walk for point in plant.lines[edge]]
    if driven is None:
        return 'a route that does not say by which road'
    if len(made.route) > 1 and not lies_on(driven, [ordered]):
        return 'a route over other ground than the order'
    if not loops and (not lies_on(ordered, [driven]) or abs(length(driven) - length(ordered)) > 2 * OVER * len(driven)):
        return 'an order that is not driven as a whole'
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--kbc', required=True, type=lambda path: pathlib.Path(path).resolve())
    parser.add_argument('--count', type=int, default=200)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--keep', type=pathlib.Path, help='a folder for the layouts that fail')
    chosen = parser.parse_args()
    failed = refused = full = 0
    with tempfile.TemporaryDirectory() as temporary:
        for number in range(chosen.count):
            plant = Plant(random.Random(f'{chosen.seed} {number}'))
            texts = {'plant.json': json.dumps(plant.layout()), 'order.json': json.dumps(plant.order())}
            for name, text in texts.items():
                (pathlib.Path(temporary) / name).write_text(text)
            made = run(chosen.kbc, 'import', 'lif', 'plant.json', '--order', 'order.json', cwd=temporary)
            if made.returncode == 1 and 'KB1408' in made.stderr:   # more than eight roads at a place
                refused += 1
                continue
            fault = fault_of(plant, made.stdout, made.stderr) if made.returncode == 0 else f'exit {made.returncode}: {made.stderr}'
            full += not leaves_out(made.stderr)
            if fault is None:
                continue
            failed += 1
            print(f'layout {number} of seed {chosen.seed}: {fault}')
            if chosen.keep:
                chosen.keep.mkdir(parents=True, exist_ok=True)
                for name, text in texts.items():
                    (chosen.keep / f'{number}-{name}').write_text(text)
    print(f'{chosen.count - failed - refused} layouts good, {failed} not, {refused} refused; {full} looked at in full')
    sys.exit(1 if failed or 2 * full < chosen.count else 0)


main()
