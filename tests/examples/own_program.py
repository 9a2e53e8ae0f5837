#!/usr/bin/env python3
"""The program of examples/11_own_program drives the simulated robot through what can happen on a mission, on the map of the example and on one
whose roads lie at all angles. It has to come to its goal, and to touch nothing, wherever kbc's own driver does, which perceives and drives by the same
headers.

  own_program.py KBC SOURCE PROGRAM PROGRAM_OF_EIGHT_SIDES
"""
import dataclasses
import os
import pathlib
import random
import subprocess
import sys
import tempfile

KBC, ROOT, PROGRAM, PROGRAM_OF_EIGHT_SIDES = (os.path.abspath(argument) for argument in sys.argv[1:5])
BEGINS = '[[event]]\nwhen = { time = 1 }\npress = "Bake"\n'


@dataclasses.dataclass
class Yard:
    program: str
    folder: pathlib.Path
    goal: str
    roads: list     # of the mission, in its order
    others: list
    unread: list    # signs
    unsafe: list
    scenarios: list   # that lie in the folder
    drives_of_a_kind: int


YARDS = [
    Yard(PROGRAM, pathlib.Path(ROOT, 'examples', '11_own_program'), 'Oven', ['Dock.E', 'Arch.E', 'Press.S'], ['Dock.S', 'Arch.S', 'Store.E'],
         ['Arch.W', 'Press.W'], ['Dock', 'Arch', 'Press'], ['crate', 'carried', 'blind'], 4),
    Yard(PROGRAM_OF_EIGHT_SIDES, pathlib.Path(ROOT, 'tests', 'examples', 'eight_sides'), 'North',
         ['Hub.NE', 'Ash.S', 'Elm.NE', 'Fir.S', 'Mill.SW', 'Oak.NW', 'Hub.N'], ['Elm.W', 'Ash.E', 'Oak.N'], ['Ash.SW', 'Fir.SW', 'Mill.N'], ['Hub', 'Elm', 'Mill'], [], 3),
]


def event(when, what):
    return f'[[event]]\nwhen = {{ {when} }}\n{what}\n'


KINDS = {
    'a crate stands on a road': lambda yard, dice: event('time = 0', f'obstacle = "crate"\nroad = "{dice.choice(yard.roads)}"\nmetres = {dice.uniform(0.6, 1.4):.2f}\nradius = 0.1'),
    'somebody steps onto the road': lambda yard, dice: event(f'road = "{yard.roads[0]}", metres = 0.4', f'obstacle = "person"\nroad = "{yard.roads[0]}"\nmetres = {dice.uniform(1.0, 1.4):.2f}\nradius = 0.1\nfor = {dice.uniform(2, 15):.0f}'),
    'paint is worn': lambda yard, dice: event('time = 0', f'wear = "{yard.roads[0]}"\nfrom = {dice.uniform(0.3, 0.8):.2f}\nto = {dice.uniform(1.2, 2.0):.2f}'),
    'a road is closed': lambda yard, dice: event(f'time = {dice.choice([0, 8, 16])}', f'close = "{dice.choice(yard.roads[1:])}"'),
    'a crossing is not safe for a while': lambda yard, dice: event('time = 0', f'unsafe = "{dice.choice(yard.unsafe)}"\nfor = {dice.uniform(20, 50):.0f}'),
    'a sense is silent for a while': lambda yard, dice: event(f'time = {dice.uniform(4, 30):.1f}', f'sensor = "{dice.choice(["line", "range", "compass", "odometry", "tag"])}"\nfault = "dead"\nfor = {dice.uniform(1, 5):.1f}'),
    'a tag cannot be read': lambda yard, dice: event('time = 0', f'tag = "{dice.choice(yard.unread)}"\nreads = "nothing"'),
    'it is carried to another road': lambda yard, dice: event(f'road = "{yard.roads[0]}", metres = {dice.uniform(0.5, 1.4):.2f}', f'kidnap = {{ road = "{dice.choice(yard.others)}", metres = {dice.uniform(0.3, 1.0):.2f} }}'),
}


def drive(yard, scenario, *driver):
    environment = dict(os.environ, WAYMARK_LIBRARY=os.path.join(ROOT, 'stdlib_rules'))
    run = subprocess.run([KBC, 'sim', 'mission.kb', '--scenario', scenario, '--expect', f'arrived at {yard.goal}', *driver], cwd=yard.folder, env=environment,
                         capture_output=True, text=True, timeout=300, check=False)
    return run.returncode == 0, run.stdout + run.stderr


def scenarios_of(yard, folder):
    scenarios = [(str(yard.folder / f'{name}.toml'), name) for name in yard.scenarios]
    for kind, make in KINDS.items():
        for i in range(yard.drives_of_a_kind):
            path = folder / f'{yard.goal}_{kind.replace(" ", "_")}_{i}.toml'
            path.write_text(f'seed = {i}\nlimit = 400\n{BEGINS}{make(yard, random.Random(path.name))}')
            scenarios.append((str(path), f'{kind}, {i}'))
    return scenarios


failed = []
with tempfile.TemporaryDirectory() as made:
    for yard in YARDS:
        for path, name in scenarios_of(yard, pathlib.Path(made)):
            kbc_arrives, _ = drive(yard, path)
            arrives, said = drive(yard, path, '--driver', yard.program)
            print(f'{"ok" if arrives else "not by either" if not kbc_arrives else "FAIL"}: to {yard.goal}, {name}')
            if kbc_arrives and not arrives:
                failed.append(f'{name}\n{pathlib.Path(path).read_text()}\n{said}')
            if not kbc_arrives and not path.startswith(made):
                failed.append(f'{name}: kbc does not arrive')
print(*failed, sep='\n')
sys.exit(1 if failed else 0)
