#!/usr/bin/env python3
"""Installs the build into an empty prefix and builds somebody else's project against it: once with find_package, once with
pkg-config and make. Also: that a change in an imported .kb compiles the knowledge base again, that man pages and completion
are there, and that the package may be moved.

    run.py --build BUILD --route1 route1.kb --cmake cmake --compiler g++
"""
import argparse
import os
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def run(*command, cwd=None, env=None):
    done = subprocess.run(command, cwd=cwd, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(command)}\n{done.stdout}")
    return done.stdout


def expect(claim, what):
    if not claim:
        sys.exit(f"failed: {what}")
    print(f"ok: {what}")


def build_with_cmake(options, prefix, scratch):
    project, build = os.path.join(scratch, "project"), os.path.join(scratch, "cmake")
    cmake = options.cmake
    run(cmake, "-S", project, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_COMPILER={options.compiler}",
        f"-DROUTE1={options.route1}", "-DCMAKE_BUILD_TYPE=Release")
    run(cmake, "--build", build)
    out = run(os.path.join(build, "bumper"))
    expect(out.count("\n") == 7, "find_package: the project builds and drives")

    header = os.path.join(build, "bumper_mind.kb", "bumper.kb.h")
    before = os.stat(header).st_mtime_ns
    run(cmake, "--build", build)
    expect(os.stat(header).st_mtime_ns == before, "nothing changed, nothing is compiled")
    imported = os.path.join(project, "parts", "button.kb")
    with open(imported, "a", encoding="utf-8") as file:
        file.write("fact Bell\n")
    os.utime(imported)
    run(cmake, "--build", build)
    with open(header, encoding="utf-8") as file:
        expect("Bell" in file.read(), "a change in an imported file compiles the knowledge base again")


def build_with_make(options, prefix, scratch):
    project = os.path.join(scratch, "project")
    folders = [os.path.join(prefix, lib, "pkgconfig") for lib in ("lib", "lib64", "lib/x86_64-linux-gnu")]
    env = dict(os.environ, PKG_CONFIG_PATH=":".join(folders + [os.environ.get("PKG_CONFIG_PATH", "")]), CXX=options.compiler)
    run("make", f"ROUTE1={options.route1}", cwd=project, env=env)
    out = run(os.path.join(project, "bumper"))
    expect(out.count("\n") == 7, "pkg-config and make: the project builds and drives")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name in ("build", "route1", "cmake", "compiler"):
        parser.add_argument("--" + name, required=True)
    options = parser.parse_args()
    os.environ.pop("WAYMARK_LIBRARY", None)

    scratch = os.path.join(options.build, "install_test")
    shutil.rmtree(scratch, ignore_errors=True)
    first, prefix = os.path.join(scratch, "first"), os.path.join(scratch, "moved")
    run(options.cmake, "--install", options.build, "--prefix", first)
    shutil.move(first, prefix)
    shutil.copytree(os.path.join(HERE, "project"), os.path.join(scratch, "project"))

    for path in ("bin/kbc", "include/waymark/runtime/mind.h", "share/waymark/stdlib_rules/std/navigation.kb",
                 "share/man/man1/kbc.1", "share/bash-completion/completions/kbc"):
        expect(os.path.getsize(os.path.join(prefix, path)) > 0, f"installed: {path}")
    build_with_cmake(options, prefix, scratch)
    build_with_make(options, prefix, scratch)
    print("install: all is well")
    return 0


if __name__ == "__main__":
    sys.exit(main())
