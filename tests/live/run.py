#!/usr/bin/env python3
"""`kbc sim --live` as a visitor meets it: the page, a road closed as by its slider, a port that is taken, Ctrl-C, also
at a hundredth of the speed.

  run.py KBC LIBRARY ROUTE
"""
import contextlib
import http.client
import json
import pathlib
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

KBC, LIBRARY, ROUTE = sys.argv[1:]
LONGEST = 120.0   # seconds; a machine may be busy


def sim(*options, stdout=subprocess.PIPE):
    command = [KBC, 'sim', ROUTE, '--library', LIBRARY, '-w', *options]
    return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=stdout, stderr=subprocess.PIPE, text=True)


@contextlib.contextmanager
def running(*options, **how):
    drive = sim(*options, **how)
    try:
        yield drive
    finally:
        drive.kill()
        drive.wait()


def port_in(line):
    return int(line.split(':')[2].split('/')[0])


def ask(port, path, body=None):
    connection = http.client.HTTPConnection('127.0.0.1', port, timeout=30)
    headers = {'Content-Type': 'application/json'} if body else {}
    connection.request('POST' if body else 'GET', path, json.dumps(body) if body else None, headers)
    answer = connection.getresponse()
    text = answer.read().decode()
    connection.close()
    return answer.status, text


def expect(holds, what):
    if not holds:
        raise SystemExit(f'FAIL: {what}')
    print('ok:', what)


def until(holds, what):
    end = time.monotonic() + LONGEST
    while not holds():
        expect(time.monotonic() < end, what)
        time.sleep(0.05)
    print('ok:', what)


def silent(port):
    """A connection that says that a command comes, and then nothing."""
    connection = socket.create_connection(('127.0.0.1', port), timeout=30)
    connection.sendall(b'POST /live/command HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\nContent-Length: 4000\r\n\r\n')
    return connection


def drip(connections, over):
    while not over.wait(0.5):
        for connection in connections:
            with contextlib.suppress(OSError):
                connection.sendall(b' ')


def beside_silent_connections():
    over = threading.Event()
    with contextlib.ExitStack() as stack:
        stack.callback(over.set)
        drive = stack.enter_context(running('--live', '0', '--speed', '0.01'))
        port = port_in(drive.stderr.readline())
        held = [silent(port) for _ in range(100)]
        status, _ = ask(port, '/')
        expect(status == 200, f'the page is served beside {len(held)} connections that say nothing')
        threading.Thread(target=drip, args=([silent(port) for _ in range(40)], over)).start()
        time.sleep(1.0)
        drive.send_signal(signal.SIGINT)
        drive.communicate(timeout=50)
        expect(drive.returncode == 130, 'Ctrl-C does not wait for connections that say a byte now and then')


def main():
    with tempfile.TemporaryDirectory() as folder:
        page, out = pathlib.Path(folder) / 'drive.html', pathlib.Path(folder) / 'out'
        with out.open('w') as stdout, running('-q', '--live', '0', '--speed', '40', '--html', str(page), stdout=stdout) as drive:
            line = drive.stderr.readline()
            expect(line.startswith('http://127.0.0.1:'), f'it says where the page is: {line.strip()}')
            port = port_in(line)
            status, text = ask(port, '/')
            expect(status == 200 and text.lower().startswith('<!doctype html>'), 'the page is served')
            status, _ = ask(port, '/live/command', {'what': 'close', 'name': 'LM7.E--LM13.N'})
            expect(status == 200, 'a road is closed as its slider does it')
            status, _ = ask(port, '/live/command', {'what': 'close', 'name': 'no such road'})
            expect(status == 400, 'a road that there is not cannot be closed')

            other = sim('--live', str(port))
            _, said = other.communicate(timeout=LONGEST)
            expect(other.returncode == 1 and 'KB1332' in said, 'a port that is taken is told')

            until(lambda: json.loads(ask(port, '/live/frames?from=0')[1])['over'], 'the drive comes to its end')
            until(lambda: 'arrived' in out.read_text(), 'how it ended is told when it ends')
            expect('LM11' in out.read_text(), 'it arrived by the way round')
            expect(drive.poll() is None and ask(port, '/')[0] == 200, 'the page stays')
            told = out.read_text()
            drive.send_signal(signal.SIGINT)
            drive.communicate(timeout=LONGEST)
            expect(drive.returncode == 0 and out.read_text() == told, 'Ctrl-C ends it in order, and tells nothing twice')
            expect('road LM7.E--LM13.N closed' in page.read_text(), 'the drive was written, with what was done to it')
    with running('--live', '0', '--speed', '0.01', '--dt', '1s') as slow:   # a tick lasts 100 s
        slow.stderr.readline()
        slow.send_signal(signal.SIGINT)
        slow.communicate(timeout=50)
        expect(slow.returncode == 130, 'Ctrl-C does not wait for the next tick, and breaks off a drive that is not over')
    beside_silent_connections()


main()
