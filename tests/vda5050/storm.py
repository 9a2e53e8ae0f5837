#!/usr/bin/env python3
"""Masters that say anything at any time, to a vehicle that drives in the simulator.

  storm.py KBC [FIRST COUNT]      drives with the seeds FIRST to FIRST + COUNT - 1
  storm.py --host FILE COMMAND    is a robot's host between simulator and COMMAND: FILE says when it is slow, and what it adds to lines

Each seed makes a script of orders, updates, cancels, pauses and requests. Whatever comes, states keep to the order that was taken, the
robot moves only while it has one, and in the end nothing is left undone without a reason that the master was told. Exit code 0: so it
was; 1: what was wrong is printed, with its seed; 77: the package python3-jsonschema is missing.
"""
import csv
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve()
ROADS = {'Inn': ['Well'], 'Well': ['Inn', 'Mill'], 'Mill': ['Well', 'Barn'], 'Barn': ['Mill']}
YARD = '''
import std.navigation
import std.retreat
map Yard {
    landmark Inn at (0, 0)
    landmark Well at (3, 0)
    landmark Mill at (6, 0)
    landmark Barn at (6, 3)
    road Inn.E -- Well.W by mark
    road Well.E -- Mill.W by mark
    road Mill.N -- Barn.S by mark
}
control Move.mark      = follow_line(speed: 0.4 m/s)
control Cross[t, mark] = turn_on_line(turn: t, speed: 0.2 m/s)
control Round = turn_round()
'''
SKILLS = ('pick=3s', 'wait=1s', 'host')
BRAKES_S, SHAKES_M = 1.5, 0.05   # so long a robot may still move that is to stand; so far the noise of its wheels turns it
OVER = ('FINISHED', 'FAILED')
BY_ITSELF = {'from': 0, 'to': 1e9, 'add': {'vehicle': {'mode': 'AUTOMATIC'}}}   # what the host says of its mode holds until it says otherwise


class Master:
    def __init__(self):
        self.lines = []

    def say(self, t, topic, body):
        head = {'headerId': len(self.lines), 'timestamp': '2026-01-01T00:00:00.000Z', 'version': '2.1.0', 'manufacturer': 'Waymark', 'serialNumber': '1'}
        self.lines.append({'t': round(t, 3), 'topic': topic, 'message': {**head, **body}})

    def order(self, t, name, update, way, released=None, sequence=0, actions=None):
        """`actions`: by index of the node."""
        released = len(way) if released is None else released
        nodes = [{'nodeId': node, 'sequenceId': sequence + 2 * i, 'released': i < released, 'actions': (actions or {}).get(i, [])} for i, node in enumerate(way)]
        edges = [{'edgeId': f'{a}-{b}', 'sequenceId': sequence + 2 * i + 1, 'released': i + 1 < released, 'startNodeId': a, 'endNodeId': b, 'actions': []}
                 for i, (a, b) in enumerate(zip(way, way[1:]))]
        self.say(t, 'order', {'orderId': name, 'orderUpdateId': update, 'nodes': nodes, 'edges': edges})

    def instant(self, t, kind, name, blocking='NONE'):
        self.say(t, 'instantActions', {'actions': [action(kind, name, blocking)]})


def action(kind, name, blocking='HARD', **more):
    return {'actionType': kind, 'actionId': name, 'blockingType': blocking, **more}


class Storm:
    """A script, and when the robot is driven by hand."""

    def __init__(self, seed, until_s=100.0):
        self.random, self.master, self.by_hand, self.made = random.Random(seed), Master(), [], 0
        self.order = None
        self.at = self.random.choice(['Well', 'Well', 'Mill'])
        t = self.random.uniform(0, 3)
        while t < until_s:
            t = self.blow(t)
            t += self.random.choice([0, 0.01, 0.02, 0.1, self.random.uniform(0, 2), self.random.uniform(0, 10), self.random.uniform(5, 30)])
        self.master.instant(max(t, until_s) + 1, 'stopPause', 'the last')
        self.master.lines.sort(key=lambda line: line['t'])

    def name(self, letter):
        self.made += 1
        return f'{letter}{self.made}'

    def way(self, begin, most=4):
        way = [begin]
        for _ in range(self.random.randint(0, most)):
            way.append(self.random.choice(ROADS[way[-1]]))
        return way

    def actions(self, way, first=0):
        kinds, blocking = ['pick', 'wait', 'wait'], ['NONE', 'SOFT', 'HARD']
        return {i: [action(self.random.choice(kinds), self.name('a'), self.random.choice(blocking))] for i in range(first, len(way)) if self.random.random() < 0.25}

    def blow(self, t):
        chance = self.random.random()
        if self.order is None or chance < 0.15:
            self.begin(t)
        elif chance < 0.5:
            self.update(t)
        elif chance < 0.62:
            self.master.instant(t, 'startPause', self.name('p'))
            self.master.instant(t + self.random.choice([0, 0.02, 0.1, 1, 5]), 'stopPause', self.name('p'))
        elif chance < 0.74:
            return self.cancel(t)
        elif chance < 0.8:
            kind = self.random.choice(['stateRequest', 'factsheetRequest', 'initPosition', 'wait', 'pick', 'nonsense'])
            self.master.instant(t, kind, self.name('q'), self.random.choice(['NONE', 'SOFT', 'HARD']))
        else:
            self.order = None
            if chance < 0.84:
                mode = self.random.choice(['MANUAL', 'SEMIAUTOMATIC', 'SERVICE'])
                self.by_hand.append({'from': t, 'to': t + self.random.choice([0.02, 0.1, 3]), 'add': {'vehicle': {'mode': mode}}})
        return t

    def begin(self, t):
        way = self.way(self.at if self.random.random() < 0.9 else self.random.choice(list(ROADS)))
        released, name = self.random.randint(1, len(way)), self.name('o')
        self.master.order(t, name, 0, way, released, actions=self.actions(way))
        if self.order is None or self.random.random() < 0.3:
            self.order, self.updates, self.sequence, self.end = name, 0, 2 * (released - 1), way[released - 1]

    def update(self, t):
        way = self.way(self.end, 3)
        released = self.random.randint(1, len(way))
        self.updates += 1
        self.master.order(t, self.order, self.updates, way, released, self.sequence, self.actions(way, 1))
        self.sequence, self.end = self.sequence + 2 * (released - 1), way[released - 1]

    def cancel(self, t):
        """And an order from wherever it may stand then: one of them is taken."""
        self.master.instant(t, 'cancelOrder', self.name('c'))
        t += self.random.choice([0, 0, 0.02, 0.1, 1, 20])
        for node in ROADS:
            way = self.way(node, 3)
            self.master.order(t, self.name('n'), 0, way, actions=self.actions(way))
        self.order, self.at = None, self.random.choice(list(ROADS))
        return t


class Drive:
    """What came of a script: `messages`, `places` (t, x, y, heading), how the simulator ended."""

    def __init__(self, kbc, lines, limit_s, host=None):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / 'yard.kb').write_text(YARD, encoding='utf-8')
            (folder / 'scenario.toml').write_text(f'limit = {limit_s}\n[start]\nroad = "Inn.E"\nmetres = 1.0\n', encoding='utf-8')
            (folder / 'orders.jsonl').write_text(''.join(json.dumps(line) + '\n' for line in lines), encoding='utf-8')
            command = f'{kbc} drive yard.kb --orders orders.jsonl --messages messages.jsonl ' + ' '.join(f'--skill {skill}' for skill in SKILLS)
            if host:
                (folder / 'host.json').write_text(json.dumps(host), encoding='utf-8')
                command = f'{sys.executable} {HERE} --host host.json {command}'
            ran = subprocess.run([kbc, 'sim', 'yard.kb', '--scenario', 'scenario.toml', '--csv', 'drive.csv', '--driver', command], cwd=folder,
                                 capture_output=True, text=True, check=False)
            self.code, self.said = ran.returncode, ran.stderr
            written = folder / 'messages.jsonl'
            self.text = written.read_text(encoding='utf-8') if written.exists() else ''
            self.messages = [json.loads(line) for line in self.text.splitlines()]
            with open(folder / 'drive.csv', encoding='utf-8') as file:
                self.places = [tuple(float(row[key]) for key in ('t', 'x_m', 'y_m', 'heading_rad')) for row in csv.DictReader(file)]

    def states(self):
        return [(one['t'], one['message']) for one in self.messages if one['topic'] == 'state']

    def moved_m(self, begin_s, end_s):
        """A turn counts as a wheel that turns a tenth of a metre from the middle."""
        seen = [place for place in self.places if begin_s <= place[0] <= end_s]
        turned = [abs((a[3] - b[3] + math.pi) % (2 * math.pi) - math.pi) for a, b in zip(seen, seen[1:])]
        return sum(math.dist(a[1:3], b[1:3]) for a, b in zip(seen, seen[1:])) + 0.1 * sum(turned)


class Order:
    """The parts of the order that a state is about, with all updates: {sequenceId: (id, released)}."""

    def __init__(self):
        self.key, self.parts = ('', 0), {}

    def take(self, message):
        parts = {part['sequenceId']: (part.get('nodeId') or part['edgeId'], part['released']) for part in message['nodes'] + message['edges']}
        first = message['nodes'][0]['sequenceId']
        if message['orderId'] == self.key[0]:
            parts = {**{at: part for at, part in self.parts.items() if at <= first}, **{at: part for at, part in parts.items() if at > first}}
        self.key, self.parts = (message['orderId'], message['orderUpdateId']), parts

    def faults(self, state, before):
        left = state['nodeStates'] + state['edgeStates']
        at, nodes, edges = state['lastNodeSequenceId'], [n['sequenceId'] for n in state['nodeStates']], [e['sequenceId'] for e in state['edgeStates']]
        if nodes and self.parts.get(at, ('',))[0] != state['lastNodeId']:
            yield f'the last node {state["lastNodeId"]} ({at}) is not of the order'
        back = nodes[:1] == [at]   # the last one lies behind the robot, and it comes to it once more
        if nodes[back:] != list(range(at + 2, at + 2 + 2 * len(edges), 2)) or edges != [node - 1 for node in nodes[back:]]:
            yield f'nodes {nodes} and edges {edges} are left after {at}'
        if any(self.parts.get(part['sequenceId']) != (part.get('nodeId') or part['edgeId'], part['released']) for part in left):
            yield f'{left} is left of {self.parts}'
        if before and before['orderId'] == state['orderId'] and nodes and at < before['lastNodeSequenceId']:
            yield f'the last node went from {before["lastNodeSequenceId"]} back to {at}'


def faults_of_states(drive):
    order, said, before, actions = Order(), [], None, {}
    for one in drive.messages:
        message = one['message']
        if one['from'] == 'master':
            said += [message] if one['topic'] == 'order' else []
        elif one['topic'] == 'state':
            key = (message['orderId'], message['orderUpdateId'])
            if key != order.key:
                taken = [order_said for order_said in said if (order_said['orderId'], order_said['orderUpdateId']) == key]
                if not taken:
                    yield f'{one["t"]}: nobody has given order {key}'
                    return
                order.take(taken[-1])
            yield from (f'{one["t"]}: {fault}' for fault in order.faults(message, before))
            before = message
            for doing in message['actionStates']:
                was = actions.get(doing['actionId'])
                if was in OVER and doing['actionStatus'] != was:
                    yield f'{one["t"]}: action {doing["actionId"]} went from {was} to {doing["actionStatus"]}'
                actions[doing['actionId']] = doing['actionStatus']


def faults_of_wheels(drive):
    stands_s = None
    for t, state in drive.states() + [(math.inf, None)]:
        cancels = state is not None and any(doing['actionType'] == 'cancelOrder' and doing['actionStatus'] not in OVER for doing in state['actionStates'])
        may = state is None or (not state['paused'] and (cancels or any(node['released'] for node in state['nodeStates'])))
        if may and stands_s is not None and drive.moved_m(stands_s + BRAKES_S, t) > SHAKES_M:
            yield f'{stands_s}: it moves {drive.moved_m(stands_s + BRAKES_S, t):.2f} m while it is to stand'
        stands_s = None if may else t if stands_s is None else stands_s


def faults_of_end(drive):
    _, state = drive.states()[-1]
    why = [error for error in state['errors'] if error['errorType'] == 'cannotGoOn' or error['errorType'].startswith('Help.')]
    left = [node['nodeId'] for node in state['nodeStates'] if node['released']]
    undone = [doing['actionId'] for doing in state['actionStates'] if doing['actionStatus'] not in OVER]
    if left and not why:
        yield f'in the end {left} are left, and nobody knows why'
    if undone and not why and not state['nodeStates']:
        yield f'in the end the actions {undone} are not over'
    if (state['driving'] and not why) or state['paused']:   # one that is lost may look round for its sign
        yield 'in the end it drives, or pauses'


def check(drive, schemas):
    import check_schemas
    if drive.code not in (0, 1) or not drive.states():
        return [f'exit code {drive.code}: {drive.said}']
    times = [one['t'] for one in drive.messages]
    faults = [] if times == sorted(times) else ['times of messages fall']
    if schemas:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'messages.jsonl')
            pathlib.Path(path).write_text(drive.text, encoding='utf-8')
            faults += check_schemas.check_file(path, schemas)[0]
    return faults + list(faults_of_states(drive)) + list(faults_of_wheels(drive)) + list(faults_of_end(drive))


def a_host_that_is_slow(kbc):
    """Hears of each message when its own clock says so; what was written down can be played, and comes to the same."""
    master = Master()
    master.order(1, 'A', 0, ['Well', 'Mill'])
    master.order(5.03, 'A', 1, ['Mill', 'Barn'], sequence=2)
    quick, slow = Drive(kbc, master.lines, 40), Drive(kbc, master.lines, 40, [{'from': 4.99, 'to': 5.01, 'sleep': 0.4}])
    if slow.text != quick.text:
        yield 'a slow host hears other messages'
    again = Drive(kbc, quick.messages, 40)
    if again.text != quick.text:
        yield 'a drive that is played becomes another'


def a_node_that_is_behind_it(kbc):
    """Just behind a sign it was driven by hand. Its compass tells it that the node is behind it: it stops at the next one."""
    master = Master()
    master.order(1, 'A', 0, ['Well', 'Mill', 'Barn'])
    master.order(30, 'B', 0, ['Well', 'Mill'])
    _, state = Drive(kbc, master.lines, 60, [BY_ITSELF, {'from': 10, 'to': 15, 'add': {'vehicle': {'mode': 'MANUAL'}}}]).states()[-1]
    if state['orderId'] != 'B' or state['lastNodeId'] != 'Mill' or state['nodeStates'] or state['errors']:
        yield f'it is at {state["lastNodeId"]}, and says {state["errors"]}'


def a_pause_in_which_it_is_carried_away(kbc):
    """Driven by hand for five seconds it does not know where it is, whether it pauses or not."""
    master = Master()
    master.order(1, 'A', 0, ['Well', 'Mill'])
    master.instant(11, 'startPause', 'p')
    master.instant(18, 'stateRequest', 's')
    _, state = Drive(kbc, master.lines, 20, [BY_ITSELF, {'from': 12, 'to': 17, 'add': {'vehicle': {'mode': 'MANUAL'}}}]).states()[-1]
    if 'agvPosition' in state:
        yield f'it is told at {state["agvPosition"]}'


def a_button_that_is_held_down(kbc):
    """Somebody's hand on Abort: it does not set out, and the master may take the order back."""
    master = Master()
    master.order(1, 'A', 0, ['Well', 'Mill'])
    master.instant(10, 'cancelOrder', 'c')
    _, state = Drive(kbc, master.lines, 12, [{'from': 0.5, 'to': 20, 'add': {'buttons': ['Abort']}}]).states()[-1]
    if state['nodeStates'] or [doing['actionStatus'] for doing in state['actionStates']] != ['FINISHED']:
        yield f'{[node["nodeId"] for node in state["nodeStates"]]} are left, and the order is not cancelled'


def more_actions_than_a_line_holds(kbc):
    """A host is told of them in turn; it does none of them."""
    master, long = Master(), [{'key': 'text', 'value': 'x' * 60_000}]
    master.order(1, 'A', 0, ['Well'], actions={0: [action('host', f'h{i}', 'NONE', actionParameters=long) for i in range(20)]})
    drive = Drive(kbc, master.lines, 3)
    if drive.code not in (0, 1) or 'KB1382' in drive.said or not drive.states()[-1][1]['actionStates']:
        yield f'the simulator does not understand it: {drive.said}'


def be_host(windows, command):
    """Between simulator and driver, line by line."""
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1) as driver:
        for line in sys.stdin:
            senses = json.loads(line)
            now = [window for window in windows if window['from'] <= senses['t'] < window['to']]
            for window in now:
                senses.update(window.get('add', {}))
                time.sleep(window.get('sleep', 0))
            driver.stdin.write(json.dumps(senses) + '\n')
            print(driver.stdout.readline(), end='', flush=True)
        driver.stdin.close()
        return driver.wait()


def main():
    if sys.argv[1:2] == ['--host']:
        return be_host(json.loads(pathlib.Path(sys.argv[2]).read_text(encoding='utf-8')), sys.argv[3:])
    import check_schemas
    kbc, schemas = os.path.abspath(sys.argv[1]), check_schemas.validators()
    first, count = (int(word) for word in sys.argv[2:4]) if len(sys.argv) > 3 else (1, 25)
    faults = [f'{known.__name__}: {fault}' for known in (a_host_that_is_slow, a_node_that_is_behind_it, a_pause_in_which_it_is_carried_away, a_button_that_is_held_down, more_actions_than_a_line_holds) for fault in known(kbc)]
    for seed in range(first, first + count):
        storm = Storm(seed)
        drive = Drive(kbc, storm.master.lines, 230, [BY_ITSELF] + storm.by_hand if storm.by_hand else None)
        faults += [f'seed {seed}: {fault}' for fault in check(drive, schemas if seed % 5 == 0 else None)]
    print('\n'.join(faults + [f'drives: {count}, {len(faults)} faults']))
    return 1 if faults else 0


if __name__ == '__main__':
    sys.exit(main())
