#!/usr/bin/env python3
"""An order that is paused and cancelled anywhere on its way, and the next one, driven in the simulator.

  pauses.py KBC [FROM TO STEP]    with pauses that begin at these seconds

The robot drives from Inn over Well and Mill to Barn. Wherever the pause catches it, before a stop line, on it, in a crossing or just out of it,
the order that is cancelled ends, and the next one is driven to its end. Exit code 1: it is not; what was wrong is printed, with the time.
"""
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

from storm import YARD, Master

ON = {'Inn': 'Well', 'Well': 'Mill', 'Mill': 'Barn', 'Barn': 'Mill'}
START = 'limit = 110\n[start]\nroad = "Inn.E"\nmetres = 1.0\n'


def script(at_s):
    master = Master()
    master.order(1, 'A', 0, ['Well', 'Mill', 'Barn'])
    master.instant(at_s, 'startPause', 'pause')
    master.instant(at_s + 2, 'cancelOrder', 'cancel')
    master.instant(at_s + 4, 'stopPause', 'go on')
    for first, then in ON.items():   # only one of them begins where the robot is
        master.order(at_s + 30, f'from {first}', 0, [first, then])
    return ''.join(json.dumps(line) + '\n' for line in master.lines)


def states(path):
    told = [json.loads(line) for line in path.read_text(encoding='utf-8').splitlines()]
    return [one['message'] for one in told if one['from'] == 'vehicle' and one['topic'] == 'state']


def wrong(kbc, folder, at_s):
    """What went wrong with a pause at this time; empty: nothing."""
    orders, told = folder / f'{at_s}.orders.jsonl', folder / f'{at_s}.told.jsonl'
    orders.write_text(script(at_s), encoding='utf-8')
    driver = f'{kbc} drive {folder}/yard.kb --orders {orders} --messages {told}'
    ended = subprocess.run([kbc, 'sim', str(folder / 'yard.kb'), '--scenario', str(folder / 'start.toml'), '--driver', driver], capture_output=True, text=True, check=False)
    last = states(told)[-1]
    actions = {action['actionId']: action['actionStatus'] for action in last['actionStates']}
    if 'fault' in ended.stdout:
        return ended.stdout
    if actions.get('cancel', 'FINISHED') != 'FINISHED':
        return f'the order is not cancelled: {actions}'
    left = [node['nodeId'] for node in last['nodeStates']]
    if not last['orderId'].startswith('from ') or left or last['lastNodeId'] != ON[last['orderId'][5:]]:
        return f'`{last["orderId"]}` is at {last["lastNodeId"]} and has still to drive to {left}; {[error["errorDescription"] for error in last["errors"]]}'
    return ''


def main():
    kbc = os.path.abspath(sys.argv[1])
    first_s, last_s, step_s = map(float, sys.argv[2:5] or (3, 26, 0.3))
    times = [round(first_s + i * step_s, 2) for i in range(int((last_s - first_s) / step_s) + 1)]
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(2) as runs:
        folder = pathlib.Path(name)
        (folder / 'yard.kb').write_text(YARD, encoding='utf-8')
        (folder / 'start.toml').write_text(START, encoding='utf-8')
        faults = [(at_s, fault) for at_s, fault in zip(times, runs.map(lambda at_s: wrong(kbc, folder, at_s), times)) if fault]
    for at_s, fault in faults:
        print(f'FAIL: a pause at {at_s} s: {fault}')
    print(f'{len(times)} pauses, {len(faults)} of them with a fault')
    sys.exit(1 if faults else 0)


if __name__ == '__main__':
    main()
