"""What the tests of this folder share: how kbc is called, layouts for it, and how a mission ends."""
import collections
import subprocess
import sys


def run(*command, cwd=None):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, stdin=subprocess.DEVNULL, cwd=cwd, check=False)


def lif(places, ways):
    """A layout of places, by their names, and of ways: id, from, to, the points of the line, what is said of it besides."""
    nodes = [{'nodeId': name, 'nodePosition': {'x': x, 'y': y}} for name, (x, y) in places.items()]
    edges = []
    for name, begin, end, line, besides in ways:
        points = [{'x': x, 'y': y} for x, y in line]
        curve = {'degree': 1, 'knotVector': [0, *range(len(line)), len(line) - 1], 'controlPoints': points}
        edges.append({'edgeId': name, 'startNodeId': begin, 'endNodeId': end,
                      'vehicleTypeEdgeProperties': [{'vehicleTypeId': 'v', 'trajectory': curve, **besides}]})
    return {'layouts': [{'layoutId': 'L', 'nodes': nodes, 'edges': edges}]}


def ending(sim):
    """How the robot of `kbc sim` ends: `arrives`, and nothing else, if all is well."""
    ends = ['arrives' if sim.stdout.startswith('arrived at ') else sim.stdout.splitlines()[0]]
    if 'collisions  0' not in sim.stdout:
        ends.append('collides')
    if 'lost without knowing it: no' not in sim.stdout:
        ends.append('is lost without knowing it')
    return ', '.join(ends)


def tally(pool, drive, numbers, well):
    """How often each end comes. Missions that end otherwise than `well` are named, and their files kept."""
    ends = collections.Counter()
    for end, file in pool.map(drive, numbers):
        ends[end] += 1
        if end in well:
            file.unlink(missing_ok=True)
        else:
            print(f'{file.stem}: {end}', file=sys.stderr)
    return ends


def in_words(ends):
    return ', '.join(f'{n} {end}' for end, n in sorted(ends.items()))
