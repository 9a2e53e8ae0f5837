#!/usr/bin/env python3
"""A vehicle and its master over a broker: mosquitto on a free port of this machine, a master of few words, and a robot that stands at the Inn.

  broker.py COMMAND ARGUMENT...

COMMAND is the vehicle Acme/7 with the floor of town.kb, as `kbc drive` would be: lines of senses on its standard input, a line of answer for each.
`{broker}` in an argument becomes the URL of the broker. Exit code 77: mosquitto or paho-mqtt is not installed.
"""
import datetime
import fcntl
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

try:
    import paho.mqtt.client as mqtt
except ImportError:
    mqtt = None

DEBIAN = '/usr/bin/python3'   # sees Debian's packages, as another Python on the PATH does not
MOSQUITTO = shutil.which('mosquitto') or shutil.which('mosquitto', path='/usr/sbin:/usr/local/sbin')
LONGEST = 60.0   # seconds; a machine may be busy
MOST_BYTES, MOST_WAITING = 4 << 20, 64
PERIOD = 0.02    # of a control period
VEHICLE = 'uagv/v2/Acme/7'
HEADER = ('headerId', 'timestamp', 'version', 'manufacturer', 'serialNumber')


def expect(holds, what):
    if not holds:
        raise SystemExit(f'FAIL: {what}')
    print('ok:', what, flush=True)


class Broker:
    """mosquitto on a port of its own. A retained message does not outlive it."""

    def __init__(self, folder):
        with socket.socket() as free:
            free.bind(('127.0.0.1', 0))
            self.port = free.getsockname()[1]
        self.url = f'mqtt://127.0.0.1:{self.port}'
        self.config = pathlib.Path(folder) / 'mosquitto.conf'
        self.config.write_text(f'listener {self.port} 127.0.0.1\nallow_anonymous true\npersistence false\n')
        self.process = None
        self.start()

    def start(self):
        self.process = subprocess.Popen([MOSQUITTO, '-c', str(self.config)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + LONGEST
        while time.monotonic() < until and self.process.poll() is None:
            with socket.socket() as knock:
                if knock.connect_ex(('127.0.0.1', self.port)) == 0:
                    return
            time.sleep(0.05)
        raise SystemExit('FAIL: mosquitto does not listen')

    def stop(self):
        self.process.terminate()
        self.process.wait(LONGEST)


class Master:
    """Hears all that the vehicle says, and sends what a test wants."""

    def __init__(self, broker):
        self.heard = []          # (topic, message, retained, quality of service)
        self.changed = threading.Condition()
        self.numbers = {}        # of messages, by topic
        self.connected = threading.Event()
        new = getattr(mqtt, 'CallbackAPIVersion', None)   # of paho-mqtt 2
        self.client = mqtt.Client(new.VERSION1) if new else mqtt.Client()
        self.client.on_connect = self._on_connect
        self.client.on_message = self._on_message
        self.client.reconnect_delay_set(0.2, 0.5)
        self.client.connect('127.0.0.1', broker.port)
        self.client.loop_start()
        self.wait_until_connected()

    def wait_until_connected(self):
        if not self.connected.wait(LONGEST):
            raise SystemExit('FAIL: the master cannot reach the broker')

    def _on_connect(self, client, *_):
        client.subscribe([(f'{VEHICLE}/{topic}', 1) for topic in ('connection', 'state', 'factsheet', 'visualization')])
        self.connected.set()

    def _on_message(self, _client, _userdata, message):
        with self.changed:
            self.heard.append((message.topic.rsplit('/', 1)[1], json.loads(message.payload), bool(message.retain), message.qos))
            self.changed.notify_all()

    def close(self):
        self.client.disconnect()
        self.client.loop_stop()

    def now(self):
        """A mark: `wait` may be told to look only at what came after it."""
        with self.changed:
            return len(self.heard)

    def wait(self, topic, holds, what, since=0):
        """The first message of `topic` after `since` for which `holds`; the test has failed if none comes."""
        until = time.monotonic() + LONGEST
        with self.changed:
            looked = since
            while True:
                for heard in self.heard[looked:]:
                    if heard[0] == topic and holds(heard[1]):
                        print('ok:', what, flush=True)
                        return heard
                looked = len(self.heard)
                if not self.changed.wait_for(lambda: len(self.heard) > looked, until - time.monotonic()):
                    last = [heard[1] for heard in self.heard if heard[0] == topic][-1:]
                    raise SystemExit(f'FAIL: {what}; of {len(self.heard)} messages the last `{topic}` was {json.dumps(last)}')

    def wait_connection(self, state, what, since=0):
        return self.wait('connection', lambda message: message['connectionState'] == state, what, since)

    def send(self, topic, body, retain=False, **header):
        number = self.numbers[topic] = self.numbers.get(topic, -1) + 1
        stamp = datetime.datetime.now(datetime.timezone.utc).strftime('%Y-%m-%dT%H:%M:%S.%f')[:-4] + 'Z'
        message = {'headerId': number, 'timestamp': stamp, 'version': '2.1.0', 'manufacturer': 'Acme', 'serialNumber': '7', **header, **body}
        self.client.publish(f'{VEHICLE}/{topic}', json.dumps(message), retain=retain).wait_for_publish(LONGEST)

    def order(self, name, nodes, edges=(), update=0, description=''):
        """`nodes` are released, as are the edges between them: (id, first, last)."""
        self.send('order', {'orderId': name, 'orderUpdateId': update, 'orderDescription': description,
                            'nodes': [{'nodeId': node, 'sequenceId': 2 * i, 'released': True, 'actions': []} for i, node in enumerate(nodes)],
                            'edges': [{'edgeId': edge, 'sequenceId': 2 * i + 1, 'released': True, 'startNodeId': first, 'endNodeId': last, 'actions': []}
                                      for i, (edge, first, last) in enumerate(edges)]})

    def act(self, name, kind, **parameters):
        """An instant action."""
        self.send('instantActions', {'actions': [{'actionId': name, 'actionType': kind, 'blockingType': 'NONE',
                                                  'actionParameters': [{'key': key, 'value': value} for key, value in parameters.items()]}]})


def is_of_now(message):
    then = datetime.datetime.fromisoformat(message['timestamp'].replace('Z', '+00:00'))
    return abs((datetime.datetime.now(datetime.timezone.utc) - then).total_seconds()) < LONGEST


def retained_connection(broker):
    """What a master that comes later hears of the vehicle at once."""
    late = Master(broker)
    heard = late.wait('connection', lambda message: True, 'a master that comes later hears of the connection')
    late.close()
    return heard


class Robot:
    """The vehicle's process, and a robot that stands at the Inn and says so every 20 ms."""

    def __init__(self, command, broker, stderr=None):
        self.process = subprocess.Popen([part.replace('{broker}', broker.url) for part in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=stderr)
        self.said, self.ends = {'vehicle': {'battery': 80}}, threading.Event()   # what stands in each line besides the senses
        self.speaks = threading.Event()   # its clock stands still while it does not
        self.speaks.set()
        self.answers = 0
        self.t = 0.0
        self.alone = threading.Lock()     # whoever speaks for the robot
        self.thread = threading.Thread(target=self._stand)
        self.thread.start()

    def _stand(self):
        try:
            while not self.ends.is_set():
                self.speaks.wait()
                with self.alone:
                    self._say()
                    if not self.process.stdout.readline():
                        return
                self.answers += 1
                time.sleep(PERIOD)
        except (BrokenPipeError, ValueError):
            return

    def _say(self):
        self.t += PERIOD
        line = {'t': round(self.t, 2), 'line': [0.05, 0.05, 0.95, 0.05, 0.05], 'range_m': [4] * 8, 'compass_rad': 0, 'odometry_x_m': 0, 'odometry_y_m': 0,
                'odometry_m_s': 0, 'odometry_turned_rad': 0, 'touched': False, 'tag': {'landmark': 'Inn', 'exit': 'E'}, **self.said}
        self.process.stdin.write(json.dumps(line).encode() + b'\n')
        self.process.stdin.flush()

    def is_silent_for(self, seconds):
        self.speaks.clear()
        time.sleep(seconds)
        self.speaks.set()

    def is_heard_and_takes_nothing(self, meanwhile):
        """Its lines wait in the pipe, and so do the answers."""
        with self.alone:
            fcntl.fcntl(self.process.stdout, fcntl.F_SETPIPE_SZ, 4096)
            lines = 100
            for _ in range(lines):   # of lines there is room for two hundred
                self._say()
            meanwhile()
            for _ in range(lines):
                self.process.stdout.readline()

    def says_nothing_but_bytes(self, meanwhile):
        with self.alone:
            ends = threading.Event()

            def flood():
                while not ends.is_set():
                    self.process.stdin.write(b'x' * 4096)
                self.process.stdin.write(b'\n')
                self.process.stdin.flush()
            thread = threading.Thread(target=flood)
            thread.start()
            meanwhile()
            ends.set()
            thread.join()
            self.process.stdout.readline()

    def leave(self):
        """As a robot that is switched off: nothing more is said. Returns the exit code."""
        self.ends.set()
        self.thread.join()
        self.process.stdin.close()
        return self.process.wait(LONGEST)

    def end(self, which):
        self.process.send_signal(which)
        code = self.process.wait(LONGEST)
        self.ends.set()
        self.thread.join()
        return code


def comes_and_tells(master, broker):
    online = master.wait_connection('ONLINE', 'the vehicle comes')
    expect(all(key in online[1] for key in HEADER) and online[1]['version'].startswith('2.') and online[1]['serialNumber'] == '7', 'each message has a header')
    expect(online[3] == 1, '`connection` comes with quality of service 1')
    late = retained_connection(broker)
    expect(late[2] and late[1]['connectionState'] == 'ONLINE', 'and is retained')
    state = master.wait('state', lambda message: message['lastNodeId'] == 'Inn', 'it says where it stands, when it has read the sign')
    expect(state[3] == 0 and not state[2] and state[1]['orderId'] == '' and state[1]['batteryState']['batteryCharge'] == 80, 'and that it has no order, and how full its battery is')
    shown = [master.wait('visualization', lambda message: message['headerId'] == number, f'it says so every second: {number}') for number in (1, 2)]
    expect(all(one[3] == 0 and not one[2] and 'x' in one[1]['agvPosition'] for one in shown), 'and nobody keeps that')


def answers_questions(master):
    mark = master.now()
    master.act('ask-1', 'factsheetRequest')
    sheet = master.wait('factsheet', lambda message: True, 'the factsheet comes when it is asked for', mark)
    expect('typeSpecification' in sheet[1] and 'protocolFeatures' in sheet[1], 'and says what kind of vehicle it is')
    master.act('ask-2', 'stateRequest')
    master.wait('state', lambda message: {'ask-1', 'ask-2'} <= {action['actionId'] for action in message['actionStates'] if action['actionStatus'] == 'FINISHED'},
                'the state says that both questions are answered', mark)


def takes_orders(master):
    mark = master.now()
    master.order('lost', ['Nowhere', 'Well'], [('e1', 'Nowhere', 'Well')])
    refused = master.wait('state', lambda message: message['errors'], 'an order that begins nowhere is refused', mark)
    expect(refused[1]['orderId'] == '' and all(key in refused[1]['errors'][0] for key in ('errorType', 'errorLevel')), 'it is none of its orders')
    master.client.publish(f'{VEHICLE}/order', b'{"orderId": ')
    master.client.publish(f'{VEHICLE}/order', b'\xff\x00')
    mark = master.now()
    master.order('stay', ['Inn'])
    taken = master.wait('state', lambda message: message['orderId'] == 'stay', 'after what is no JSON an order is taken: to stay', mark)
    expect(taken[1]['orderUpdateId'] == 0 and taken[1]['edgeStates'] == [], 'and nothing is to be driven for it')
    master.order('long', ['Inn'], description='x' * 3_000_000)
    master.wait('state', lambda message: message['orderId'] == 'long', 'one of three megabytes as well, which is less than the factsheet allows', mark)


def is_told_of_what_was_dropped(master, robot):
    def complains(words):
        return lambda message: any(words in error['errorDescription'] for error in message['errors'])
    mark = master.now()
    master.client.publish(f'{VEHICLE}/order', b' ' * (MOST_BYTES + 100))
    master.wait('state', complains('is longer than'), 'of a message that is too long the master is told', mark)
    mark = master.now()
    robot.process.send_signal(signal.SIGSTOP)   # so that all come at once
    for _ in range(5 * MOST_WAITING):
        master.client.publish(f'{VEHICLE}/order', b'{}')
    time.sleep(0.5)
    robot.process.send_signal(signal.SIGCONT)
    master.wait('state', complains('dropped'), 'and of messages that were too many', mark)


def asks(master, name, what):
    mark = master.now()
    master.act(name, 'stateRequest')
    master.wait('state', lambda message: any(action['actionId'] == name for action in message['actionStates']), what, mark)


def is_silent(message):
    return any(error['errorType'] == 'robotSilent' for error in message['errors'])


def answers_while_its_robot_is_stuck(master, robot):
    robot.is_heard_and_takes_nothing(lambda: (
        master.wait('state', is_silent, 'of a robot that takes no answers its master is told', master.now()),
        asks(master, 'stuck-1', 'and is answered')))
    master.wait('state', lambda message: not is_silent(message), 'until it takes them', master.now())
    robot.says_nothing_but_bytes(lambda: (
        master.wait('state', is_silent, 'of a robot that sends bytes without end, and no line, its master is told', master.now()),
        asks(master, 'stuck-2', 'and is answered')))
    master.wait('state', lambda message: not is_silent(message), 'until it sends a line', master.now())


def hears_what_the_base_says(master, robot):
    mark = master.now()
    robot.said['vehicle'] = {'battery': 12.5, 'charging': True, 'e_stop': 'MANUAL', 'mode': 'MANUAL'}
    master.wait('state', lambda message: message['safetyState']['eStop'] == 'MANUAL' and message['batteryState']['batteryCharge'] == 12.5, 'what the base says of itself is told', mark)
    mark = master.now()
    robot.said['vehicle'] = {'battery': 80, 'charging': False}
    after = master.wait('state', lambda message: message['batteryState']['batteryCharge'] == 80, 'and what it says no more', mark)
    expect(after[1]['safetyState']['eStop'] == 'MANUAL' and after[1]['operatingMode'] == 'MANUAL', 'stays as it was')
    robot.said['vehicle'] = {'e_stop': 'NONE', 'mode': 'AUTOMATIC'}


def is_written_down(master, robot, written):
    """While the robot is silent its master is answered by the clock of this machine, and the robot's comes after that."""
    for name in ('ask-4', 'ask-5'):
        mark = master.now()
        threading.Timer(0.3, lambda name=name: master.act(name, 'stateRequest')).start()
        robot.is_silent_for(2.0)
        master.wait('state', lambda message, name=name: any(action['actionId'] == name for action in message['actionStates']), 'one that is silent hears its master', mark)
        master.wait('state', lambda message: any(error['errorType'] == 'robotSilent' for error in message['errors']), 'and says that its robot is silent', mark)
    expect(robot.leave() == 0, 'one that is switched off ends well')
    times = [json.loads(line)['t'] for line in written.read_text(encoding='utf-8').splitlines()]
    expect(len(times) > 4 and times == sorted(times), 'what passed is a script: its time does not fall')


def names_who_takes_its_connection(robot, folder):
    said = pathlib.Path(folder) / 'said'
    with said.open('wb') as file:
        two = [robot(stderr=file), robot()]
        until = time.monotonic() + LONGEST
        while b'another program has the name of this vehicle' not in said.read_bytes():
            if time.monotonic() > until:
                raise SystemExit(f'FAIL: a vehicle whose name is taken says so: {said.read_bytes()}')
            time.sleep(0.1)
    print('ok: a vehicle whose name is taken says so', flush=True)
    for one in two:
        one.leave()


def outlives_its_broker(master, broker, robot):
    last = [heard[1] for heard in master.heard if heard[0] == 'state'][-1]
    broker.stop()
    answered = robot.answers
    time.sleep(1.0)
    expect(robot.answers > answered, 'the robot is answered while there is no broker')
    master.connected.clear()
    mark = master.now()
    broker.start()
    master.wait_until_connected()
    online = master.wait_connection('ONLINE', 'it comes back by itself', mark)
    expect(is_of_now(online[1]) and online[1]['headerId'] > 0, 'with the time of now, and a number of its own')
    state = master.wait('state', lambda message: True, 'and tells its state', mark)
    expect(is_of_now(state[1]) and state[1]['headerId'] > last['headerId'], 'as it is now')
    master.wait('factsheet', lambda message: True, 'and its factsheet, which the broker has forgotten', mark)
    mark = master.now()
    master.act('ask-3', 'stateRequest')
    master.wait('state', lambda message: any(action['actionId'] == 'ask-3' for action in message['actionStates']), 'and hears its master again', mark)


def run(command, folder):
    broker = Broker(folder)
    robots = []

    def robot(*more, stderr=None):
        robots.append(Robot([*command, *more], broker, stderr))
        return robots[-1]
    try:
        master = Master(broker)
        kept = {'orderId': 'kept', 'orderUpdateId': 0, 'nodes': [{'nodeId': 'Inn', 'sequenceId': 0, 'released': True, 'actions': []}], 'edges': []}
        master.send('order', kept, retain=True)   # of yesterday: the states show that nobody took it
        first = robot()
        comes_and_tells(master, broker)
        answers_questions(master)
        takes_orders(master)
        hears_what_the_base_says(master, first)
        is_told_of_what_was_dropped(master, first)
        answers_while_its_robot_is_stuck(master, first)
        outlives_its_broker(master, broker, first)
        mark = master.now()
        first.end(signal.SIGKILL)
        broken = master.wait_connection('CONNECTIONBROKEN', 'of a vehicle that is killed the broker says so', mark)
        online = [heard[1] for heard in master.heard if heard[0] == 'connection' and heard[1]['connectionState'] == 'ONLINE'][-1]
        expect(broken[1]['headerId'] == online['headerId'] + 1 and is_of_now(broken[1]), 'in a message that follows the one before')
        expect(retained_connection(broker)[1]['connectionState'] == 'CONNECTIONBROKEN', 'and says it to whoever comes later')
        for how in ('is switched off', 'is interrupted'):
            mark = master.now()
            another = robot()
            master.wait_connection('ONLINE', 'it comes again', mark)
            mark = master.now()
            if how == 'is switched off':
                expect(another.leave() == 0, 'one that is switched off ends well')
            else:
                another.end(signal.SIGTERM)
            master.wait_connection('OFFLINE', f'one that {how} takes its leave', mark)
            expect(retained_connection(broker)[1]['connectionState'] == 'OFFLINE', 'and the broker does not take it for broken')
        mark = master.now()
        written = pathlib.Path(folder) / 'messages.jsonl'
        another = robot('--messages', str(written))
        master.wait_connection('ONLINE', 'it comes again', mark)
        is_written_down(master, another, written)
        names_who_takes_its_connection(robot, folder)
        master.close()
    finally:
        for one in robots:
            if one.process.poll() is None:
                one.end(signal.SIGKILL)
        broker.stop()


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if mqtt is None and os.path.exists(DEBIAN) and os.path.realpath(sys.executable) != os.path.realpath(DEBIAN):
        os.execv(DEBIAN, [DEBIAN, *sys.argv])
    if mqtt is None or MOSQUITTO is None:
        print('skipped: mosquitto or paho-mqtt is not installed')
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        run(sys.argv[1:], folder)


if __name__ == '__main__':
    main()
