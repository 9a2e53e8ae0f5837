#!/usr/bin/env python3
"""A vehicle and its master over a broker: mosquitto on a free port of this machine, a master of few words, and a robot that stands at the Inn.

  broker.py COMMAND ARGUMENT...

COMMAND is the vehicle Acme/7 with the floor of town.kb, as `kbc drive` would be: lines of senses on its standard input, a line of answer for each.
`{broker}` in an argument becomes the URL of the broker. Exit code 77: mosquitto or paho-mqtt is not installed.
"""
import datetime
import json
import os
import pathlib
import signal
import sys
import tempfile
import threading
import time

from cast import LONGEST, MOSQUITTO, VEHICLE, Broker, Master, Robot, expect, mqtt

DEBIAN = '/usr/bin/python3'   # sees Debian's packages, as another Python on the PATH does not
MOST_BYTES, MOST_WAITING = 4 << 20, 64
HEADER = ('headerId', 'timestamp', 'version', 'manufacturer', 'serialNumber')


def is_of_now(message):
    then = datetime.datetime.fromisoformat(message['timestamp'].replace('Z', '+00:00'))
    return abs((datetime.datetime.now(datetime.timezone.utc) - then).total_seconds()) < LONGEST


def retained_connection(broker):
    """What a master that comes later hears of the vehicle at once."""
    late = Master(broker)
    heard = late.wait('connection', lambda message: True, 'a master that comes later hears of the connection')
    late.close()
    return heard


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
