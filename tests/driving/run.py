#!/usr/bin/env python3
"""`kbc drive` and `kbc sim --driver` as a robot and a student meet them: a line for a line, signals, pipes that nobody reads, drivers that
leave something behind, and the same drive bit by bit with the mind in another process.

  run.py KBC SOURCE
"""
import filecmp
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import tempfile
import time

KBC, ROOT = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
LIBRARY = str(ROOT / 'stdlib_rules')
LABYRINTH = ROOT / 'examples' / '04_simulator'
HALLS = ROOT / 'examples' / '07_open_hall'
OWN = ROOT / 'examples' / '09_own_driver'
ENVIRONMENT = dict(os.environ, PATH=os.path.dirname(KBC) + os.pathsep + os.environ['PATH'], WAYMARK_LIBRARY=LIBRARY)
LONGEST = 120.0   # seconds; a machine may be busy
CSV_OF_THE_WORLD = 23   # columns: time, place, senses

ANOTHER_ROBOT = '''
[robot]
radius = 0.15
wheel_base = 0.25
speed = 0.4
acceleration = 0.8
[sensors.range]
rate = 10
latency = 0.05
noise = 0.08
[[crossing]]
landmark = "LM3"
methods = ["azimuth"]
[[event]]
when = { time = 2 }
unsafe = "LM6"
for = 40
'''


def expect(holds, what):
    if not holds:
        raise SystemExit(f'FAIL: {what}')
    print('ok:', what)


def drive(*options, folder=LABYRINTH, file='route1.kb', **more):
    return subprocess.Popen([KBC, 'drive', file, '-w', *options], cwd=folder, env=ENVIRONMENT, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, **more)


def sim(*options, folder=LABYRINTH, file='route1.kb'):
    return subprocess.run([KBC, 'sim', file, '-w', *options], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=LONGEST, check=False)


def ask(process, line):
    process.stdin.write(line.encode() + b'\n')
    process.stdin.flush()
    return json.loads(process.stdout.readline())


def a_line_for_a_line():
    process = drive()
    expect(ask(process, '{"t":0}')['speed'] == 0, 'each line is answered before the next one comes')
    expect(ask(process, 'nonsense')['error']['line'] == 2, 'what is no line is answered as well')
    expect(ask(process, '{"t":0.02}')['t'] == 0.02, 'and the next one counts')
    process.stdin.close()
    expect(process.wait(LONGEST) == 1 and process.stdout.read() == b'', 'at the end nothing more is said; there was a mistake: exit code 1')
    process = drive()
    process.stdin.write(b'{"t":0}\r\n{"t":0.02}')
    process.stdin.close()
    expect(process.stdout.read().count(b'\n') == 2 and process.wait(LONGEST) == 0, 'CR LF, and a last line without a line break')


def signals():
    for which in (signal.SIGINT, signal.SIGTERM):
        with tempfile.TemporaryDirectory() as folder:
            record = pathlib.Path(folder) / 'drive.jsonl'
            process = drive('--record', str(record))
            ask(process, '{"t":0}')
            process.send_signal(which)
            last = json.loads(process.stdout.readline())
            expect(last['speed'] == 0 and last['turn'] == 0 and last['end'] == 'interrupted', f'{which.name}: the last word is that the wheels stand')
            expect(process.wait(LONGEST) == 130 and record.read_text().count('\n') == 1, f'{which.name}: the recording is kept')


def closed_streams():
    with tempfile.TemporaryDirectory() as folder:
        record = pathlib.Path(folder) / 'drive.jsonl'
        for closed in ('0<&-', '1>&-'):
            done = subprocess.run(f"{KBC} drive route1.kb -w --record {record} {closed}", shell=True, cwd=LABYRINTH, env=ENVIRONMENT, input=b'{"t":0}\n', capture_output=True,
                                  timeout=LONGEST, check=False)
            expect(done.returncode == 1 and b'error' in done.stderr and record.read_bytes() == b'', f'{closed}: the recording does not take the place of a stream that is closed')


def recordings_grow():
    with tempfile.TemporaryDirectory() as folder:
        names = [pathlib.Path(folder) / name for name in ('drive.jsonl', 'drive.facts.csv', 'drive.trace.jsonl')]
        options = [text for option, name in zip(('--record', '--facts', '--trace'), names) for text in (option, str(name))]
        names[0].write_text('old')
        process = drive(*options)
        for i in range(11):
            ask(process, '{"t":%g}' % (0.1 * i))
        wanted = dict(zip(names, (10, 10, 8)))   # lines: at least; the last answer may be ahead of the disk
        for name, lines in wanted.items():
            beside = next(name.parent.glob(name.name + '.*'))
            expect(beside.read_text().count('\n') >= lines, f'{name.name} grows beside its place while it drives')
        process.kill()
        process.wait(LONGEST)
        expect(names[0].read_text() == 'old' and len(list(names[0].parent.iterdir())) == 4, 'a drive that is killed leaves what it has written, and what stood there before')
        again = drive(*options)
        again.communicate(b'{"t":0}\n', LONGEST)
        expect(again.returncode == 0 and names[0].read_text().startswith('{"t":0,"answered":') and len(list(names[0].parent.iterdir())) == 6, 'and the next drive leaves it as well')


def a_disk_that_is_full():
    def little_room():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
    with tempfile.TemporaryDirectory() as folder:
        record, trace = pathlib.Path(folder) / 'drive.jsonl', pathlib.Path(folder) / 'trace.jsonl'
        record.write_text('old')
        process = drive('--record', str(record), '--trace', str(trace), preexec_fn=little_room)
        for i in range(20):
            last = ask(process, '{"t":%g}' % (0.02 * i))
        expect('error' not in last and b'KB0904' in process.stderr.readline(), 'a disk that is full is told of at once, and the robot drives on')
        process.stdin.close()
        beside = next(record.parent.glob('drive.jsonl.*'))
        expect(process.wait(LONGEST) == 1 and record.read_text() == 'old' and beside.stat().st_size == 2000, 'exit code 1; the old recording stays, and what was written of the new one')
        expect(trace.read_text().count('\n') == 4, 'what had room is whole')


def nobody_listens():
    process = drive()
    ask(process, '{"t":0}')
    process.stdout.close()
    try:
        for i in range(1, 1000):
            process.stdin.write(b'{"t":%d}\n' % i)
            process.stdin.flush()
    except BrokenPipeError:
        pass
    expect(process.wait(LONGEST) == 0 and process.stderr.read() == b'', 'nobody listens any more: it ends, quietly')


def the_same_drive_in_another_process():
    cases = [(LABYRINTH, 'route1.kb', name) for name in ('plain', 'detour', 'obstacle', 'blind_compass', 'power_lost', 'abort', 'kidnapped', 'wrong_tag')]
    cases += [(HALLS, f'{mind}.kb', scenario) for mind, scenario in (('bug', 'furnished'), ('neural_map', 'crates'), ('fuzzy', 'aisle'), ('potential', 'trap'))]
    with tempfile.TemporaryDirectory() as folder:
        another = pathlib.Path(folder) / 'another_robot'
        another.with_suffix('.toml').write_text(ANOTHER_ROBOT)
        for where, file, scenario in [*cases, (LABYRINTH, 'route1.kb', str(another))]:
            made = {}
            for name, more in (('own', []), ('other', ['--driver', f'kbc drive {file} -w --robot {scenario}.toml'])):
                made[name] = [str(pathlib.Path(folder) / f'{name}.{end}') for end in ('json', 'jsonl', 'csv')]
                done = sim('--scenario', f'{scenario}.toml', '--summary', made[name][0], '--trace', made[name][1], '--csv', made[name][2], *more, folder=where, file=file)
                expect(done.returncode == 0, f'{file} drives through {os.path.basename(scenario)}.toml ({name})' + done.stderr)
            rows = [[line.split(',')[:CSV_OF_THE_WORLD] for line in open(made[name][2], encoding='utf-8')] for name in made]
            same = filecmp.cmp(made['own'][0], made['other'][0], shallow=False) and filecmp.cmp(made['own'][1], made['other'][1], shallow=False)
            expect(same and rows[0] == rows[1] and len(rows[0]) > 100, f'{file} with {os.path.basename(scenario)}.toml: summary, trace and way are the same over a line')


def a_recording_is_answered_again():
    with tempfile.TemporaryDirectory() as folder:
        record, again = pathlib.Path(folder) / 'drive.jsonl', pathlib.Path(folder) / 'again.jsonl'
        sim('--scenario', 'detour.toml', '--driver', f'kbc drive route1.kb -w --record {record}')
        said = [json.loads(line) for line in record.read_text().splitlines()]
        expect(len(said) > 1000, 'a whole mission is recorded')
        answers = subprocess.run([KBC, 'drive', 'route1.kb', '-w', '--record', str(again)], cwd=LABYRINTH, env=ENVIRONMENT, stdin=open(record, 'rb'), capture_output=True,
                                 timeout=LONGEST, check=True).stdout
        expect([json.loads(line) for line in answers.splitlines()] == [one['answered'] for one in said], 'and answered again in the same way')
        expect(again.read_bytes() == record.read_bytes(), 'and recorded again as the same bytes')


def the_examples():
    done = sim('--driver', f'{sys.executable} follow.py', '--expect', 'arrived', folder=OWN, file='track.kb')
    expect(done.returncode == 0, 'a dozen lines of Python follow the line to the mill: ' + done.stdout.splitlines()[0])
    time_in_readme = next(line for line in (OWN / 'README.md').read_text().splitlines() if 'time ' in line).split()[1]
    expect(f'time        {time_in_readme} s' in done.stdout, 'in the time that its README says')
    own = sim('--expect', 'arrived', folder=OWN, file='track.kb')
    bridged = sim('--driver', f'{sys.executable} bridge.py track.kb', folder=OWN, file='track.kb')
    expect(own.returncode == 0 and own.stdout == bridged.stdout, 'the bridge drives as the knowledge base alone')
    with tempfile.TemporaryDirectory() as folder:
        scenario = pathlib.Path(folder) / 'abort.toml'
        scenario.write_text('[[event]]\nwhen = { time = 1 }\npress = "Go"\n[[event]]\nwhen = { time = 5 }\npress = "Abort"\n')
        aborted = sim('--driver', f'{sys.executable} follow.py', '--scenario', str(scenario), folder=OWN, file='track.kb')
    expect(aborted.stdout.startswith('aborted'), 'a mission that nobody tells can be aborted' + aborted.stderr)
    blocked = sim('--driver', f'{sys.executable} bridge.py track.kb', '--scenario', 'crate.toml', folder=OWN, file='track.kb')
    expect(blocked.returncode == 0 and 'collisions  0' in blocked.stdout, 'and round a crate')
    run = subprocess.run([sys.executable, '-c', 'import bridge, math\n'
                          'scan = [math.inf] * 360\nscan[0] = 1.0\nscan[350] = 0.5\nscan[90] = math.nan\n'
                          'assert bridge.eight_ranges(scan, 0.0, math.pi / 180)[:3] == [0.5, bridge.OUT_OF_RANGE_M, bridge.OUT_OF_RANGE_M]\n'
                          'assert bridge.eight_ranges([2.0] * 90, -math.pi / 4, math.pi / 180)[4] is None\n'
                          'assert abs(bridge.yaw(0, 0, math.sqrt(0.5), math.sqrt(0.5)) - math.pi / 2) < 1e-9\n'], cwd=OWN, capture_output=True, text=True, check=False,
                         env=dict(ENVIRONMENT, PYTHONDONTWRITEBYTECODE='1'))
    expect(run.returncode == 0, 'a scan becomes eight ranges' + run.stderr)


def a_mind_that_is_late():
    with tempfile.TemporaryDirectory() as folder:
        slow = pathlib.Path(folder) / 'kbc'
        slow.write_text("#!/usr/bin/env python3\nimport json, sys, time\nfor number, line in enumerate(sys.stdin):\n    time.sleep(2 if number == 1 else 0)\n"
                        "    t = json.loads(line)['t']\n    print(json.dumps({'speed': t, 'turn': 0}), flush=True)\n    if t == 9: break\n")
        slow.chmod(0o755)
        run = subprocess.run([sys.executable, '-c', 'import bridge, time\nbridge.LONGEST_WAIT_S = 1.0\nmind = bridge.Mind()\nanswers = []\n'
                              'for t in (1, 2, 3, 4):\n    answers.append((mind.step({"t": t}) or bridge.STAND)["speed"])\n    time.sleep(2 if t == 2 else 0)\n'
                              'assert answers == [1, 0, 3, 4], answers\nmind.step({"t": 9})\n'
                              'try: mind.step({"t": 10}), mind.step({"t": 11})\nexcept bridge.MindGone: mind.close()\nelse: raise SystemExit("it is not gone")\n'], cwd=OWN,
                             env=dict(ENVIRONMENT, PATH=folder + os.pathsep + ENVIRONMENT['PATH'], PYTHONDONTWRITEBYTECODE='1'), capture_output=True, text=True, timeout=LONGEST, check=False)
    expect(run.returncode == 0, 'the bridge stands while its mind is late, and passes over the late answer' + run.stderr)
    run = subprocess.run([sys.executable, str(pathlib.Path(__file__).with_name('ros.py')), str(OWN)], env=ENVIRONMENT, capture_output=True, text=True, timeout=LONGEST, check=False)
    expect(run.returncode == 0, 'the node of ROS 2 drives its stand-ins' + (run.stderr if run.returncode != 0 else ''))


def a_sensor_that_measures_the_line():
    bridge = f'{sys.executable} {pathlib.Path(__file__).with_name("guide.py")}'
    for scenario in ('plain', 'detour', 'obstacle', 'marking_lost'):
        done = sim('--scenario', f'{scenario}.toml', '--driver', f'{bridge} route1.kb', '--expect', 'arrived')
        expect(done.returncode == 0, f'a line that is measured leads through {scenario}.toml' + done.stderr)
    done = sim('--driver', f'{bridge} track.kb', '--expect', 'arrived', folder=OWN, file='track.kb')
    expect(done.returncode == 0, 'and to the mill' + done.stderr)


def nothing_is_left_behind():
    with tempfile.TemporaryDirectory() as folder:
        mark = pathlib.Path(folder) / 'children'
        # A driver that starts another program, ignores that it is asked to end, and never answers.
        command = f"trap '' TERM; sleep 300 & echo $! $$ > {mark}; wait; sleep 300"
        began = time.monotonic()
        done = sim('--driver', command, '--driver-timeout', '2s')
        expect(done.returncode == 1 and 'KB1381' in done.stderr and time.monotonic() - began < 60, 'a driver that never answers is left')
        time.sleep(0.1)
        alive = [pid for pid in mark.read_text().split() if pathlib.Path(f'/proc/{pid}').exists() and 'Z' not in pathlib.Path(f'/proc/{pid}/stat').read_text().split(')')[1]]
        expect(not alive, 'and nothing that it started lives on')
        process = subprocess.Popen([KBC, 'sim', 'route1.kb', '-w', '--driver', f'echo $$ > {mark}; exec sleep 300'], cwd=LABYRINTH, env=ENVIRONMENT, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        end = time.monotonic() + LONGEST
        while (not mark.exists() or not mark.read_text().strip().isdigit()) and time.monotonic() < end:
            time.sleep(0.05)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        expect(process.wait(LONGEST) == 130, 'Ctrl-C ends the wait for an answer')


def main():
    a_line_for_a_line()
    signals()
    closed_streams()
    recordings_grow()
    a_disk_that_is_full()
    nobody_listens()
    the_same_drive_in_another_process()
    a_recording_is_answered_again()
    the_examples()
    a_mind_that_is_late()
    a_sensor_that_measures_the_line()
    nothing_is_left_behind()


if __name__ == '__main__':
    main()
