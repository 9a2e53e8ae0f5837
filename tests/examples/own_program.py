#!/usr/bin/env python3
"""The program of examples/11_own_program drives the simulated robot through what can happen on a mission. It has to come to its goal, and to
touch nothing, wherever kbc's own mind does: both perceive the same, one by what tags remember, the other by the map.

  own_program.py KBC PROGRAM SOURCE
"""
import os
import pathlib
import random
import subprocess
import sys
import tempfile

KBC, PROGRAM, ROOT = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), pathlib.Path(sys.argv[3]).resolve()
FOLDER = ROOT / 'examples' / '11_own_program'
ROADS = ['Dock.E', 'Arch.E', 'Press.S']    # of the mission; 2.1 m from stop line to stop line
OTHERS = ['Dock.S', 'Arch.S', 'Store.E']
DRIVES_OF_A_KIND = 4
BEGINS = '[[event]]\nwhen = { time = 1 }\npress = "Bake"\n'


def event(when, what):
    return f'[[event]]\nwhen = {{ {when} }}\n{what}\n'


KINDS = {
    'a crate stands on a road': lambda dice: event('time = 0', f'obstacle = "crate"\nroad = "{dice.choice(ROADS)}"\nmetres = {dice.uniform(0.6, 1.4):.2f}\nradius = 0.1'),
    'somebody steps onto the road': lambda dice: event('road = "Dock.E", metres = 0.4', f'obstacle = "person"\nroad = "Dock.E"\nmetres = {dice.uniform(1.0, 1.4):.2f}\nradius = 0.1\nfor = {dice.uniform(2, 15):.0f}'),
    'paint is worn': lambda dice: event('time = 0', f'wear = "Dock.E"\nfrom = {dice.uniform(0.3, 0.8):.2f}\nto = {dice.uniform(1.2, 2.0):.2f}'),
    'a road is closed': lambda dice: event(f'time = {dice.choice([0, 8, 16])}', f'close = "{dice.choice(ROADS[1:])}"'),
    'a crossing is not safe for a while': lambda dice: event('time = 0', f'unsafe = "{dice.choice(["Dock", "Arch", "Press"])}"\nfor = {dice.uniform(20, 50):.0f}'),
    'a sense is silent for a while': lambda dice: event(f'time = {dice.uniform(4, 30):.1f}', f'sensor = "{dice.choice(["line", "range", "compass", "odometry", "tag"])}"\nfault = "dead"\nfor = {dice.uniform(1, 5):.1f}'),
    'a tag cannot be read': lambda dice: event('time = 0', f'tag = "{dice.choice(["Arch.W", "Press.W"])}"\nreads = "nothing"'),
    'it is carried to another road': lambda dice: event(f'road = "Dock.E", metres = {dice.uniform(0.5, 1.4):.2f}', f'kidnap = {{ road = "{dice.choice(OTHERS)}", metres = {dice.uniform(0.3, 1.0):.2f} }}'),
}


def drive(scenario, *driver):
    environment = dict(os.environ, WAYMARK_LIBRARY=str(ROOT / 'stdlib_rules'))
    run = subprocess.run([KBC, 'sim', 'mission.kb', '--scenario', scenario, '--expect', 'arrived at Oven', *driver], cwd=FOLDER, env=environment,
                         capture_output=True, text=True, timeout=300, check=False)
    return run.returncode == 0, run.stdout + run.stderr


failed = []
with tempfile.TemporaryDirectory() as folder:
    scenarios = [(str(FOLDER / f'{name}.toml'), name) for name in ('crate', 'carried', 'blind')]
    for kind, make in KINDS.items():
        for i in range(DRIVES_OF_A_KIND):
            path = pathlib.Path(folder) / f'{kind.replace(" ", "_")}_{i}.toml'
            path.write_text(f'seed = {i}\nlimit = 240\n{BEGINS}{make(random.Random(path.name))}')
            scenarios.append((str(path), f'{kind}, {i}'))
    for path, name in scenarios:
        kbc_arrives, _ = drive(path)
        arrives, said = drive(path, '--driver', PROGRAM)
        print(f'{"ok" if arrives else "not by either" if not kbc_arrives else "FAIL"}: {name}')
        if kbc_arrives and not arrives:
            failed.append(f'{name}\n{pathlib.Path(path).read_text()}\n{said}')
        if not kbc_arrives and not path.startswith(folder):
            failed.append(f'{name}: kbc does not arrive')
print(*failed, sep='\n')
sys.exit(1 if failed else 0)
