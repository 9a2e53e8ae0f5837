#!/usr/bin/env python3
"""The golden tests: runs every case and compares what kbc says with what is written beside it.

A case is one file whose first line (or lines) say what to run:

    # RUN: kbc check %s

Commands run in the case's own folder, through bash, with `kbc` on the path. In a command and in what it prints

    %s   is the name of the case's file, so that every place is printed relative
    %d   is the folder `NAME.d` beside it, for cases of several files
    %t   is a fresh folder for what the command writes

The standard library is that of this tree; its folder is written LIBRARY in what is printed.

The expectation stands in the sibling `NAME.out`: what was printed, then what went to the standard error, then the exit
code. The name of a case is a sentence, and begins with `fail_` if and only if its last command fails. A crash is never
an expectation: exit code 70, a signal, or a sanitizer's report fail whatever stands in the `.out`.

Where the first line says `# RUN LONG:`, --short leaves the case out. These are drives of minutes and inputs of megabytes: one
case of twenty, and two thirds of the time under sanitizers, over code that the others go through as well.

    run.py --kbc build/release/bin/kbc [filter...]     all cases, or those whose path has a filter in it
    run.py --kbc ... --update [filter...]              writes the expectations anew; look at the diff before you commit
    run.py --kbc ... --short [filter...]               without the long ones
"""
import argparse
import concurrent.futures
import difflib
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
LIBRARY = os.path.join(os.path.dirname(os.path.dirname(HERE)), "stdlib_rules")
NAME = re.compile(r"^[a-z0-9]+(_[a-z0-9]+)*$")
CRASH = re.compile(r"AddressSanitizer|ThreadSanitizer|runtime error:|UndefinedBehaviorSanitizer|LeakSanitizer")
TIMEOUT_S = 180   # under sanitizers the slowest case takes 9 s alone on two cores; a busy machine is several times slower
BUG_OF_OURS = 70


class Case:
    def __init__(self, path, commands, is_long):
        self.path = path
        self.commands = commands
        self.is_long = is_long
        self.folder, self.file = os.path.split(path)
        self.stem = os.path.splitext(self.file)[0]
        self.expected_path = os.path.join(self.folder, self.stem + ".out")
        self.name = os.path.relpath(path, HERE)
        self.actual = None
        self.faults = []

    def expected(self):
        if not os.path.exists(self.expected_path):
            return None
        with open(self.expected_path, encoding="utf-8", errors="surrogateescape") as file:
            return file.read()


def read_commands(path):
    """The RUN lines at the top of a file, none if it is not a case; and whether it is a long one."""
    commands, is_long = [], False
    with open(path, encoding="utf-8", errors="surrogateescape") as file:
        for line in file:
            match = re.match(r"^# RUN( LONG)?: (.+)$", line.rstrip("\n"))
            if not match:
                break
            commands.append(match.group(2))
            is_long = is_long or match.group(1) is not None
    return commands, is_long


def find_cases():
    cases, outs = [], set()
    for folder, folders, names in os.walk(HERE):
        top = os.path.relpath(folder, HERE).split(os.sep)[0]
        folders[:] = sorted(n for n in folders if not n.endswith(".d") and n not in ("traces", "runs", "__pycache__"))
        if top == ".":
            continue
        for name in sorted(names):
            path = os.path.join(folder, name)
            if name.endswith(".out"):
                outs.add(path)
                continue
            commands, is_long = read_commands(path)
            if commands:
                cases.append(Case(path, commands, is_long))
    orphans = sorted(outs - {case.expected_path for case in cases})
    return cases, orphans


def run_one(command, case, kbc, scratch):
    environment = dict(os.environ, LC_ALL="C.UTF-8", NO_COLOR="1", TZ="UTC", COLUMNS="100", WAYMARK_LIBRARY=LIBRARY)
    environment["PATH"] = os.path.dirname(kbc) + os.pathsep + environment["PATH"]
    shell = command.replace("%s", case.file).replace("%d", case.stem + ".d").replace("%t", scratch)
    try:
        done = subprocess.run(["bash", "-c", shell], cwd=case.folder, env=environment, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=TIMEOUT_S, check=False)
    except subprocess.TimeoutExpired:
        case.faults.append(f"did not end within {TIMEOUT_S} s: {command}")
        return "", "", -1
    out, err = (text.decode("utf-8", "surrogateescape").replace(scratch, "%t").replace(LIBRARY, "LIBRARY")
                for text in (done.stdout, done.stderr))
    if done.returncode < 0 or done.returncode >= BUG_OF_OURS or CRASH.search(err):
        case.faults.append(f"crashed (exit {done.returncode}): {command}\n{err}")
    return out, err, done.returncode


def run_case(case, kbc):
    parts, code = [], 0
    scratch = tempfile.mkdtemp(prefix="golden.")
    try:
        for command in case.commands:
            out, err, code = run_one(command, case, kbc, scratch)
            if len(case.commands) > 1:
                parts.append(f"$ {command}\n")
            parts.append(out if not out or out.endswith("\n") else out + "\n--- no line break at the end\n")
            if err:
                parts.append("--- stderr\n" + (err if err.endswith("\n") else err + "\n"))
            parts.append(f"--- exit {code}\n")
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    case.actual = "".join(parts)
    if case.stem.startswith("fail_") != (code != 0):
        case.faults.append(f"ends with exit {code}, but its name says otherwise: `fail_` if and only if it fails")
    if not NAME.match(case.stem):
        case.faults.append("its name is not a sentence in snake_case")
    return case


def judge(case, update):
    """The text to print for a case; empty if all is well."""
    report = [f"FAIL {case.name}: {fault}" for fault in case.faults]
    expected = case.expected()
    if expected != case.actual:
        if update and not case.faults:
            with open(case.expected_path, "w", encoding="utf-8", errors="surrogateescape") as file:
                file.write(case.actual)
            print(f"wrote {os.path.relpath(case.expected_path, HERE)}")
        elif expected is None:
            report.append(f"FAIL {case.name}: no expectation yet; look at this, then --update\n{case.actual}")
        else:
            diff = difflib.unified_diff(expected.splitlines(True), case.actual.splitlines(True), "expected", "actual")
            report.append(f"FAIL {case.name}\n" + "".join(diff))
    return "\n".join(report)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--kbc", required=True, help="the kbc to test")
    parser.add_argument("--update", action="store_true", help="write the expectations anew")
    parser.add_argument("--short", action="store_true", help="leave out the cases that are marked as long")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 2)
    parser.add_argument("filter", nargs="*", help="only cases whose path has one of these in it")
    options = parser.parse_args()
    kbc = os.path.abspath(options.kbc)
    if not os.access(kbc, os.X_OK):
        parser.error(f"{options.kbc} cannot be run")

    cases, orphans = find_cases()
    if options.filter:
        cases = [case for case in cases if any(word in case.name for word in options.filter)]
        orphans = []
    left_out = sum(case.is_long for case in cases) if options.short else 0
    if options.short:
        cases = [case for case in cases if not case.is_long]
    failed = 0
    for orphan in orphans:
        print(f"FAIL {os.path.relpath(orphan, HERE)}: belongs to no case")
        failed += 1
    sys.stdout.reconfigure(errors="surrogateescape")
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for case in pool.map(lambda c: run_case(c, kbc), cases):
            report = judge(case, options.update)
            if report:
                print(report)
                failed += 1
    print(f"{len(cases) + len(orphans) - failed} passed, {failed} failed" + (f", {left_out} long ones left out" if left_out else ""))
    return 1 if failed or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
