#!/usr/bin/env python3
"""`kbc fleet` gives the same bytes however the work is shared out: threads, shares, restarts after a kill, ranks of MPI.

  run.py KBC LIBRARY EXAMPLE
"""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

KBC, LIBRARY, EXAMPLE = sys.argv[1:]
LONGEST = 120.0   # seconds; a machine may be busy
MPI_PROGRAM = pathlib.Path(KBC).parent / 'kbc-fleet-mpi'
MPIRUN = ['mpirun', '--allow-run-as-root', '--oversubscribe', '--bind-to', 'none']
# A launcher that started this test is not to be taken for one of ours.
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith(('OMPI_', 'PMIX_', 'PMI_'))}


def expect(holds, what):
    if not holds:
        raise SystemExit(f'FAIL: {what}')
    print('ok:', what, flush=True)


def fleet(out, *options, seeds='3-10'):
    return ['fleet', f'{EXAMPLE}/route1.kb', '--scenario', f'{EXAMPLE}/plain.toml', '--scenario', f'{EXAMPLE}/tag_unreadable.toml',
            '--seeds', seeds, '--robots', '2', '--library', LIBRARY, '-w', '--out', str(out), *options]


def start(command):
    return subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)


def run(command, code=0):
    process = start(command)
    out, error = process.communicate(timeout=LONGEST)
    good = process.returncode != 0 if code is None else process.returncode == code
    expect(good, f'{" ".join(map(str, command[-4:]))} ends with {"a failure" if code is None else code}' + ('' if good else f'\n{error}'))
    return out, error


def results(folder):
    return {name: (folder / name).read_bytes() for name in ('runs.csv', 'summary.md')}


def first_shard(out, process):
    """Waits until one shard is there and not all are."""
    end = time.monotonic() + LONGEST
    while not any(name.suffix == '.csv' for name in (out / 'shards').glob('*')):
        if process.poll() is not None or time.monotonic() > end:
            raise SystemExit('FAIL: it ended before it could be stopped')
        time.sleep(0.001)


def killed_and_restarted(folder, whole):
    out = folder / 'killed'
    process = start([KBC, *fleet(out, '--jobs', '1', '--shard', '1/1')])
    first_shard(out, process)
    process.kill()
    process.communicate()
    kept = {path.name: path.stat().st_mtime_ns for path in (out / 'shards').glob('*.csv')}
    expect(0 < len(kept) < 8, 'a kill leaves some shards')
    run([KBC, *fleet(out, '--shard', '1/1')])
    expect(all((out / 'shards' / name).stat().st_mtime_ns == when for name, when in kept.items()), 'what was there is not done again')
    run([KBC, *fleet(out)])
    expect(results(out) == whole, 'the same bytes after a kill')

    out = folder / 'interrupted'
    process = start([KBC, *fleet(out, '--jobs', '1')])
    first_shard(out, process)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=LONGEST)
    expect(process.returncode == 130 and 'the same command goes on' in error, 'Ctrl-C says that the same command goes on')
    run([KBC, *fleet(out)])
    expect(results(out) == whole, 'the same bytes after Ctrl-C')

    out = folder / 'interrupted_share'
    process = start([KBC, *fleet(out, '--jobs', '1', '--shard', '1/2')])
    first_shard(out, process)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=LONGEST)
    kept = len(list((out / 'shards').glob('*.csv')))
    expect(f'interrupted: {4 * kept} of 16 runs are kept' in error, 'of a share its own runs are counted')


def two_at_once(folder, whole):
    out = folder / 'twice'
    first = start([KBC, *fleet(out, '--jobs', '1')])
    first_shard(out, first)
    first.send_signal(signal.SIGSTOP)
    _, error = run([KBC, *fleet(out)], code=1)
    expect('another `kbc fleet` has it in hand' in error, 'what another command has in hand is not driven again')
    first.send_signal(signal.SIGCONT)
    first.communicate(timeout=LONGEST)
    expect(first.returncode == 0 and results(out) == whole, 'the first of two commands ends as if it were alone')

    out = folder / 'twice_and_killed'
    first = start([KBC, *fleet(out, '--jobs', '1', '--shard', '1/2')])
    first_shard(out, first)
    first.send_signal(signal.SIGSTOP)
    _, error = run([KBC, *fleet(out)], code=1)
    left = 8 - len(list((out / 'shards').glob('*.csv')))
    expect(0 < left < 4 and 'has it in hand' in error, 'the second of two commands drives what the first has not in hand')
    first.kill()
    first.communicate()
    run([KBC, *fleet(out)])
    expect(results(out) == whole, 'what a command had in hand that was killed is free')


def one_run_is_one_drive(whole):
    rows = [line.split(',') for line in whole['runs.csv'].decode().splitlines()[2:]]
    expect(len(rows) == 32 and len({row[3] for row in rows}) == 16, 'each robot has noise of its own, the same in each scenario')
    for row in (rows[0], rows[5]):
        out, _ = run([KBC, 'sim', f'{EXAMPLE}/route1.kb', '--scenario', f'{EXAMPLE}/{row[0]}.toml', '--seed', row[3], '--library', LIBRARY, '-w'])
        time_s, length_m = re.search(r'time +([\d.]+) s\n +length +([\d.]+) m', out).groups()
        expect((time_s, length_m) == (row[6], row[7]), f'robot {row[2]} with seed {row[1]} is the drive of kbc sim --seed {row[3]}')


def ranks_of(out):
    """Process numbers of the ranks that work on this folder."""
    found = []
    for entry in pathlib.Path('/proc').iterdir():
        try:
            words = (entry / 'cmdline').read_bytes().split(b'\0')
            if entry.name.isdigit() and (entry / 'comm').read_text().strip() == 'kbc-fleet-mpi' and str(out).encode() in words:
                found.append(int(entry.name))
        except OSError:
            pass   # it has ended meanwhile
    return found


def mpi(folder, whole):
    out = folder / 'ranks'
    run([*MPIRUN, '-n', '3', KBC, *fleet(out)])
    expect(results(out) == whole, 'the same bytes from three ranks')

    out = folder / 'ranks_and_threads'
    run([*MPIRUN, '-n', '2', KBC, *fleet(out, '--jobs', '2')])
    expect(results(out) == whole, 'the same bytes from two ranks of two threads')

    out = folder / 'dead_rank'
    process = start([*MPIRUN, '-n', '3', KBC, *fleet(out, seeds='3-40')])
    first_shard(out, process)
    os.kill(max(ranks_of(out)), signal.SIGKILL)
    process.communicate(timeout=LONGEST)
    kept = len(list((out / 'shards').glob('*.csv')))
    expect(process.returncode != 0 and 0 < kept < 38, f'a rank that is killed ends the job, and {kept} of 38 shards stay')
    run([*MPIRUN, '-n', '2', KBC, *fleet(out, seeds='3-40')])
    run([KBC, *fleet(folder / 'more', seeds='3-40')])
    expect(results(out) == results(folder / 'more'), 'the same bytes after a rank was killed')

    _, error = run([*MPIRUN, '-n', '3', KBC, *fleet(folder / 'wrong', '--scenario', 'nowhere.toml')], code=1)
    expect(error.count('KB0901') == 1, 'three ranks report a mistake once')
    _, error = run([*MPIRUN, '-n', '1', MPI_PROGRAM, *fleet(folder / 'other'), ':', '-n', '1', MPI_PROGRAM, *fleet(folder / 'other', seeds='1-2')], code=None)
    expect('KB1350' in error, 'a rank with other files is refused')


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run([KBC, *fleet(folder / 'one', '--jobs', '1')])
        whole = results(folder / 'one')
        expect(not (folder / 'one' / 'shards').exists(), 'shards are gone when they are put together')
        run([KBC, *fleet(folder / 'two', '--jobs', '2')])
        expect(results(folder / 'two') == whole, 'the same bytes from two threads')
        for i in (3, 1, 2):
            run([KBC, *fleet(folder / 'shares', '--shard', f'{i}/3')])
        run([KBC, *fleet(folder / 'shares', '--merge')])
        expect(results(folder / 'shares') == whole, 'the same bytes from three shares')
        run([KBC, *fleet(folder / 'shares')])
        expect(results(folder / 'shares') == whole, 'a batch that is complete stays as it is')
        killed_and_restarted(folder, whole)
        two_at_once(folder, whole)
        one_run_is_one_drive(whole)
        if shutil.which('mpirun') and MPI_PROGRAM.exists():
            mpi(folder, whole)
        else:
            print('no mpirun, or kbc was built without MPI: ranks are not tested')


main()
