#!/usr/bin/env python3
"""Drives missions between places drawn at random through plants as other programs write them: `kbc import`, then `kbc sim`.

  drive.py --kbc build/test/bin/kbc                            those of data/layouts that have ways there and back, by line
  drive.py --kbc build/test/bin/kbc --by azimuth PLANT.xml     any others

A mission that cannot be driven, since no road leads there or none to where it begins, is drawn again, up to ten times. Prints a table;
exits with 1 unless all robots arrive, touch nothing and know where they are.
"""
import argparse
import concurrent.futures
import os
import pathlib
import random
import re
import sys
import tempfile

sys.dont_write_bytecode = True
from plants import ending, in_words, run, tally  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
FORMATS = {'.xml': 'opentcs', '.geojson': 'nav2', '.json': 'lif'}
TRIES = 10   # for one mission
NONE = 'cannot be drawn'
NO_MISSION = ('KB1410', 'KB1315')   # no way; none to where it begins


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--kbc', required=True)
    parser.add_argument('--missions', type=int, default=20, help='of each plant')
    parser.add_argument('--by', default='mark', choices=('mark', 'dist', 'azimuth'))
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--keep', type=pathlib.Path, help='a folder for the missions that fail')
    parser.add_argument('plants', nargs='*', type=pathlib.Path)
    chosen = parser.parse_args()
    layouts = ROOT / 'data/layouts'
    with_ways = sorted([*layouts.glob('nav2/*.geojson'), *layouts.glob('opentcs/Demo*.xml')])
    chosen.all = not chosen.plants   # there every mission can be drawn
    chosen.plants = chosen.plants or with_ways
    return chosen


def imported(chosen, plant, *more):
    return run(chosen.kbc, 'import', FORMATS[plant.suffix], plant, '-w', '--by', chosen.by, *more)


def drive(chosen, plant, number, places, folder):
    """How one mission ends, and its file."""
    dice = random.Random(f'{chosen.seed} {plant.name} {number}')
    file = folder / f'{plant.stem}-{chosen.by}-{number}.kb'
    for _ in range(TRIES):
        route = ','.join(dice.sample(places, 2))
        made = imported(chosen, plant, '--route', route, '-o', file)
        sim = made if made.returncode else run(chosen.kbc, 'sim', file, '-w', '--seed', number, '--set', 'limit=6000')
        if any(code in sim.stderr for code in NO_MISSION):
            continue
        if made.returncode or not sim.stdout:
            return re.sub(r'.*\[(KB\d+)\].*', r'\1', sim.stderr.strip().splitlines()[0]), file
        return ending(sim), file
    return NONE, file


def main():
    chosen = options()
    good = True
    print(f'| plant | places | {chosen.missions} missions, roads by `{chosen.by}` |\n|---|---|---|')
    with tempfile.TemporaryDirectory() as temporary, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        folder = chosen.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for plant in chosen.plants:
            whole = imported(chosen, plant)
            places = re.findall(r'^ *landmark (\w+)', whole.stdout, re.MULTILINE)
            if whole.returncode or len(places) < 2:
                sys.exit(f'{plant} cannot be imported: {whole.stderr.strip() or "it has no two places"}')
            ends = tally(pool, lambda n: drive(chosen, plant, n, places, folder), range(1, chosen.missions + 1), ('arrives', NONE))
            good = good and ends['arrives'] + (0 if chosen.all else ends[NONE]) == chosen.missions
            print(f'| {plant.stem} | {len(places)} | {in_words(ends)} |', flush=True)
    sys.exit(0 if good else 1)


main()
