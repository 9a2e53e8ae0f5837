#!/usr/bin/env python3
"""Checks that some archives need nothing from outside but what every freestanding compiler provides.

    check_symbols.py [--nm nm] ARCHIVE...

The archives may need each other. An allocator, `__cxa_*` (exceptions, guards of statics, pure virtual functions), typeinfo,
streams, math: anything that is not in ALLOWED is named, with the object that needs it.
"""
import argparse
import subprocess
import sys

# A compiler may call these four for plain loops and copies; a freestanding program has to have them.
ALLOWED = {"memcpy", "memmove", "memset", "memcmp", "_GLOBAL_OFFSET_TABLE_"}


def symbols(nm, archive):
    """(defined names, {undefined name: object})"""
    text = subprocess.run([nm, "--format=posix", archive], capture_output=True, text=True, check=True).stdout
    defined, undefined, member = set(), {}, archive
    for line in text.splitlines():
        if line.endswith("]:") or line.endswith(":"):
            member = line.rstrip(":")
            continue
        words = line.split()
        if len(words) < 2:
            continue
        if words[1] in "Uwv":
            undefined.setdefault(words[0], member)
        else:
            defined.add(words[0])
    return defined, undefined


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--nm", default="nm")
    parser.add_argument("archive", nargs="+")
    options = parser.parse_args()
    defined, undefined = set(), {}
    for archive in options.archive:
        here, needed = symbols(options.nm, archive)
        defined |= here
        undefined.update(needed)
    faults = [f"{undefined[name]} needs {name}" for name in sorted(undefined) if name not in defined | ALLOWED]
    if not defined:
        faults.append("nothing is defined: are these archives empty?")
    print("\n".join(faults + [f"freestanding: {len(defined)} symbols defined, {len(faults)} faults"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
