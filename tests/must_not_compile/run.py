#!/usr/bin/env python3
"""Compiles what must not compile.

Each case is a file *.cc whose first line says what the compiler has to complain about:

    // MUST NOT COMPILE: text that stands in the message

It is compiled twice. As it stands it has to fail with that text; with -DFIXED, which takes the mistake out, it has to
compile: so it fails for the reason that is meant. The knowledge bases are those of the install test and of example 3.

    run.py --kbc KBC --root waymark --compiler g++ [--compiler clang++] -- flags...
"""
import argparse
import glob
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
MARK = "// MUST NOT COMPILE: "


def compile_one(compiler, flags, path, fixed):
    command = [compiler, "-std=c++20", "-fsyntax-only", *flags, *(["-DFIXED"] if fixed else []), path]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env=dict(os.environ, LC_ALL="C"), check=False)
    return done.returncode, done.stdout


def check(compiler, flags, path):
    """What is wrong with a case, or nothing."""
    with open(path, encoding="utf-8") as file:
        first = file.readline().rstrip("\n")
    if not first.startswith(MARK):
        return f"its first line is `{MARK}...`"
    code, text = compile_one(compiler, flags, path, fixed=True)
    if code != 0:
        return "does not even compile with the mistake taken out:\n" + text
    code, text = compile_one(compiler, flags, path, fixed=False)
    if code == 0:
        return "compiles"
    if first[len(MARK):] not in text:
        return f"is refused, but not with `{first[len(MARK):]}`:\n{text}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--kbc", required=True)
    parser.add_argument("--root", required=True)
    parser.add_argument("--compiler", action="append", required=True)
    parser.add_argument("flags", nargs="*")
    options = parser.parse_args()
    cases = sorted(glob.glob(os.path.join(HERE, "*.cc")))
    failed = 0
    with tempfile.TemporaryDirectory() as scratch:
        for knowledge_base in ("tests/install/project/bumper.kb", "examples/03_fuzzy/robot.kb"):
            subprocess.run([options.kbc, "compile", os.path.join(options.root, knowledge_base), "--out", scratch, "--fleet",
                            "--library", os.path.join(options.root, "stdlib_rules")], check=True)
        for compiler in options.compiler:
            for path in cases:
                fault = check(compiler, [*options.flags, "-I", scratch], path)
                if fault:
                    failed += 1
                    print(f"FAIL {os.path.basename(path)} ({compiler}): {fault}")
    print(f"{len(cases) * len(options.compiler) - failed} passed, {failed} failed")
    return 1 if failed or not cases else 0


if __name__ == "__main__":
    sys.exit(main())
