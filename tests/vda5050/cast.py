"""Who takes part in broker.py: the broker, a master, and a robot with its vehicle."""
import datetime
import fcntl
import json
import pathlib
import shutil
import socket
import subprocess
import threading
import time

try:
    import paho.mqtt.client as mqtt
except ImportError:
    mqtt = None

MOSQUITTO = shutil.which('mosquitto') or shutil.which('mosquitto', path='/usr/sbin:/usr/local/sbin')
LONGEST = 60.0   # seconds; a machine may be busy
PERIOD = 0.02    # of a control period
VEHICLE = 'uagv/v2/Acme/7'


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
