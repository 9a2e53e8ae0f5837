#!/usr/bin/env python3
"""Files of a fleet or a map that were left over from another version of the knowledge base must not compile with the new mind.

    left_over.py --kbc KBC --library stdlib_rules --compiler g++ [--compiler clang++] -- flags...

Each case replaces some of the files of a knowledge base by those of another version. The compiler must refuse them, and say which files are
to be made again; with all files of one version it must take them.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile

KB = """import std.navigation
map Yard {{
    landmark Dock  at (0, 0)
    landmark Arch  at (3, 0)
    landmark Shelf at {shelf}
    road Dock.E -- Arch.W  by mark at most {limit} m/s
    road Arch.E -- Shelf.W by mark
}}
command Go
{more}
route Errand on Yard by Go: Arch -> Shelf
"""
FIRST = KB.format(shelf="(6, 0)", limit="0.3", more="")
VERSIONS = {
    "a satellite more": KB.format(shelf="(6, 0)", limit="0.3", more="satellite Lamp output\nrule shine at drive when event Go then +Lamp"),
    "another limit": KB.format(shelf="(6, 0)", limit="0.2", more=""),
    "a longer road": KB.format(shelf="(9, 0)", limit="0.3", more=""),
    "a remark": KB.format(shelf="(6, 0)", limit="0.3", more="# only a remark"),
}
BY_ALL = 4   # so many cases are for each compiler, the others for one after the other: a compiler takes seconds for each
FLEET, MAP = "compile the knowledge base with --fleet again", "compile the knowledge base with --map again"


def make(options, folder, text, *form):
    os.makedirs(folder)
    with open(os.path.join(folder, "yard.kb"), "w", encoding="utf-8") as file:
        file.write(text)
    subprocess.run([options.kbc, "compile", "yard.kb", "-w", "--library", os.path.abspath(options.library), *form], cwd=folder, check=True)
    return folder


def refusal(compiler, options, folder, source):
    """What the compiler says against the file; empty if it takes it."""
    what = ["-include", source, "/dev/null"] if source.endswith(".h") else [source]   # `#pragma once` of the first file would be warned of
    done = subprocess.run([compiler, "-std=c++20", "-fsyntax-only", "-Werror", *options.flags, "-I", folder, "-x", "c++", *what], cwd=folder,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=dict(os.environ, LC_ALL="C"), check=False)
    return "" if done.returncode == 0 else done.stdout or "?"


def mixed(scratch, name, first, other, left_over):
    """A folder with the files of `other`, except those that are left over from `first`."""
    folder = os.path.join(scratch, name)
    shutil.copytree(other, folder)
    for ending in left_over:
        shutil.copy(os.path.join(first, "yard.kb" + ending), folder)
    return folder


def cases(options, scratch):
    """(what, folder, file to compile, what must be said: empty if it must compile)."""
    first = make(options, os.path.join(scratch, "first"), FIRST, "--fleet", "--map")
    plain = make(options, os.path.join(scratch, "plain"), FIRST)
    yield "all of one make", first, "yard.kb.fleet.cc", ""
    yield "all of one make", first, "yard.kb.map.h", ""
    yield "a mind made without the map", mixed(scratch, "alone", first, plain, [".map.h"]), "yard.kb.map.h", MAP
    yield "a mind made without the fleet", mixed(scratch, "alone too", first, plain, [".fleet.h", ".fleet.cc"]), "yard.kb.fleet.cc", ""
    for name, text in VERSIONS.items():
        other = make(options, os.path.join(scratch, name), text, "--fleet", "--map")
        mind, map_too = name not in ("a longer road", "a remark"), name != "a remark"
        fleet = mixed(scratch, name + ", fleet", first, other, [".fleet.h", ".fleet.cc"])
        yield f"{name}: fleet left over", fleet, "yard.kb.fleet.h", FLEET if mind else ""
        if mind:
            source = mixed(scratch, name + ", source", first, other, [".fleet.cc"])
            yield f"{name}: source of the fleet left over", source, "yard.kb.fleet.cc", FLEET
        drawn = mixed(scratch, name + ", map", first, other, [".map.h"])
        yield f"{name}: map left over", drawn, "yard.kb.map.h", MAP if map_too else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--kbc", required=True)
    parser.add_argument("--library", required=True)
    parser.add_argument("--compiler", action="append", required=True)
    parser.add_argument("flags", nargs="*")
    options = parser.parse_args()
    options.kbc = os.path.abspath(options.kbc)
    failed = passed = 0
    with tempfile.TemporaryDirectory() as scratch:
        for number, (what, folder, source, wanted) in enumerate(cases(options, scratch)):
            for compiler in options.compiler if number < BY_ALL else [options.compiler[number % len(options.compiler)]]:
                said = refusal(compiler, options, folder, source)
                good = wanted in said if wanted else not said
                passed, failed = passed + good, failed + (not good)
                if not good:
                    print(f"FAIL {what} ({compiler}): {'compiles' if not said else said}")
    print(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
