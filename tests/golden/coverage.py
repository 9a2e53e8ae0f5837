#!/usr/bin/env python3
"""Checks that every message of the compiler is shown by a golden test.

The kinds are read from compiler/diagnostics/kinds_*.def; a kind is covered if its code stands in some `.out` file (of
tests/golden or of the cases of `kbc test`), or if exemptions.txt names it with a reason, say a unit test that shows it.
An exemption that is not needed is a fault as well.
"""
import glob
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
KIND = re.compile(r"^KB_(ERROR|WARNING)\((\w+),\s*(\d+),", re.M)
CODE = re.compile(r"KB(\d{4})")


def read_kinds():
    """{code: name} of all errors and warnings."""
    kinds, faults = {}, []
    for path in sorted(glob.glob(os.path.join(ROOT, "compiler/diagnostics/kinds_*.def"))):
        with open(path, encoding="utf-8") as file:
            for _, name, code in KIND.findall(file.read()):
                if int(code) in kinds:
                    faults.append(f"KB{int(code):04} is both {kinds[int(code)]} and {name}")
                kinds[int(code)] = name
    return kinds, faults


def read_shown():
    shown, failures = set(), 0
    for path in glob.glob(os.path.join(HERE, "**/*.out"), recursive=True):
        failures += os.path.basename(path).startswith("fail_")
        with open(path, encoding="utf-8", errors="surrogateescape") as file:
            shown.update(int(code) for code in CODE.findall(file.read()))
    return shown, failures


def read_exemptions(faults):
    exempt = set()
    with open(os.path.join(HERE, "exemptions.txt"), encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            line = line.split("#")[0].strip()
            if not line:
                continue
            match = re.match(r"KB(\d{4})\s+\S", line)
            if not match:
                faults.append(f"exemptions.txt:{number}: a line is `KB0123 the reason`")
            else:
                exempt.add(int(match.group(1)))
    return exempt


def main():
    kinds, faults = read_kinds()
    shown, failures = read_shown()
    exempt = read_exemptions(faults)
    for code, name in sorted(kinds.items()):
        if code not in shown and code not in exempt:
            faults.append(f"KB{code:04} {name}: no golden shows it, and exemptions.txt gives no reason")
    for code in sorted(exempt):
        if code not in kinds:
            faults.append(f"KB{code:04}: exempt, but there is no such kind")
        elif code in shown:
            faults.append(f"KB{code:04} {kinds[code]}: exempt, but a golden shows it")
    covered = len(set(kinds) & shown)
    print("\n".join(faults + [f"messages: {len(kinds)} kinds, {covered} shown by a golden, {len(exempt)} exempt, "
                              f"{failures} cases that fail"]))
    return 1 if faults or not kinds else 0


if __name__ == "__main__":
    sys.exit(main())
