#!/usr/bin/env python3
"""The deepest stack that the call graph of a program allows: what no run can prove.

    stack_bound.py FOLDER --most BYTES

Reads what g++ -fcallgraph-info=su has written beside the objects below FOLDER. Fails if it is more than --most, if a
function may call itself, or if the stack of some function has no bound. What is called through pointers are the constructors
before main() only; they count as well.
"""
import argparse
import pathlib
import re
import sys

NODE = re.compile(r'node: \{ title: "([^"]+)" label: "([^"]*)"')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')
CONSTRUCTORS = "_GLOBAL__sub_I_"


def read(folder):
    """({function: bytes}, {function: functions that it calls}, faults)"""
    size, calls, faults = {}, {}, []
    for path in sorted(pathlib.Path(folder).rglob("*.ci")):
        for line in path.read_text(encoding="utf-8").splitlines():
            node, edge = NODE.match(line), EDGE.match(line)
            if node:
                name = node[1].split(":")[-1]
                used = re.search(r"(\d+) bytes \((\w+)\)", node[2])
                if used:
                    size[name] = max(size.get(name, 0), int(used[1]))
                    if used[2] != "static":
                        faults.append(f"{name} has a stack of {used[2]} size")
            elif edge:
                calls.setdefault(edge[1].split(":")[-1], set()).add(edge[2].split(":")[-1])
    calls["__indirect_call"] = {name for name in size if name.startswith(CONSTRUCTORS)}
    return size, calls, faults


def deepest(name, size, calls, known, above, faults):
    """(bytes, path) of the deepest calls below `name`."""
    if name in above:
        faults.append(f"{name} may call itself")
        return 0, []
    if name not in known:
        below = [deepest(called, size, calls, known, above | {name}, faults) for called in sorted(calls.get(name, ()))]
        deep, path = max(below, default=(0, []))
        known[name] = deep + size.get(name, 0), [name] + path
    return known[name]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder")
    parser.add_argument("--most", type=int, required=True)
    options = parser.parse_args()
    size, calls, faults = read(options.folder)
    if "reset_handler" not in size:
        sys.exit(f"there is no call graph of the program below {options.folder}")
    total, path = deepest("reset_handler", size, calls, {}, frozenset(), faults)
    for name in path:
        print(f"{size.get(name, 0):5} {name[:100]}")
    print(f"at most {total} bytes of stack, allowed {options.most}")
    if total > options.most:
        faults.append("too much stack")
    print("\n".join([f"fault: {f}" for f in faults] + [f"{len(faults)} faults"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
