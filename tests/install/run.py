#!/usr/bin/env python3
"""Installs the build into an empty prefix and builds somebody else's project against it: with find_package and each of two
generators, with pkg-config and make, and with the sources in its tree. Also: that a change in an imported .kb compiles the
knowledge base again, that man pages and completion are there, that the package may be moved, and that it is one for Debian too.

    run.py --build BUILD --route1 route1.kb --cmake cmake --compiler g++
"""
import argparse
import json
import os
import shlex
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


def build_with_cmake(options, prefix, scratch, generator):
    project, build = os.path.join(scratch, "project"), os.path.join(scratch, f"with {generator}")
    cmake = options.cmake
    out = run(cmake, "-S", project, "-B", build, "-G", generator, f"-DCMAKE_PREFIX_PATH={prefix}",
              f"-DCMAKE_CXX_COMPILER={options.compiler}", f"-DROUTE1={options.route1}", "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON")
    expect("Warning" not in out, f"{generator}: the package is found without a warning")
    twice = subprocess.run([cmake, "-S", project, "-B", build + " twice", "-G", generator, f"-DCMAKE_PREFIX_PATH={prefix}", f"-DROUTE1={options.route1}",
                            "-DTWICE=ON"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    said = " ".join(twice.stdout.split())   # CMake breaks lines
    expect(twice.returncode != 0 and "a_program_can_link_one_knowledge_base_of_a_namespace__give_the_other" in said and "_NAMESPACE__bumper" in said,
           f"{generator}: one namespace twice in a program is refused, and it is said what to do")
    # What the generators do each in their own way is to make knowledge bases again; what comes of them is compiled and run once.
    whole = generator == "Ninja"
    targets = [] if whole else ["--target", "near_mind", "bumper_image", "other_image"]
    build_it = [cmake, "--build", build, *targets]
    run(*build_it)
    if whole:
        out = run(os.path.join(build, "bumper"))
        expect(out.count("\n") == 7, f"{generator}: the project builds and drives")
        run(os.path.join(build, "other"))
        expect(" u " not in run("nm", "-D", os.path.join(build, "libshared.so")), "nothing in a plug-in keeps it from being unloaded")
        hand_on(options, prefix, scratch, os.path.join(build, "handed.cmake"))
        check_with_clang(build)

    image = os.path.join(build, "bumper_image.kb", "bumper.kbt")
    made = [image, os.path.join(build, "near_mind.kb", "near.kb.h")]
    if whole:
        made += [os.path.join(build, "bumper_mind.kb", "bumper.kb.h"), os.path.join(build, "sight", "senses_mind.kb", "senses.kb.h")]
    before = [os.stat(path).st_mtime_ns for path in made]
    run(*build_it)
    expect([os.stat(path).st_mtime_ns for path in made] == before, f"{generator}: nothing changed, nothing is compiled")
    imported = os.path.join(project, "parts", "button.kb")
    bell = f"Bell{len(generator)}"
    with open(imported, "a", encoding="utf-8") as file:
        file.write(f"fact {bell}\n")
    os.utime(imported)
    run(cmake, "--build", build, "--target", "bumper_mind" if whole else "bumper_image")   # all programs would tell nothing more
    with open(made[2] if whole else image, "rb") as file:
        expect(bell.encode() in file.read(), f"{generator}: a change in an imported file compiles the knowledge base again")
    upgrade(options, prefix, build, image, generator)


def check_with_clang(build):
    """All that the project compiles, read by the other compiler with the warnings that the project asks of it."""
    if shutil.which("clang++") is None:
        print("left out: clang++ is not here to read the project")
        return
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        commands = json.load(file)
    of_gcc = {"-fno-gnu-unique", "-Wuseless-cast", "-Wduplicated-cond", "-Wduplicated-branches", "-Wlogical-op"}
    for one in commands:
        words = [word for word in shlex.split(one["command"]) if word not in of_gcc]
        words = words[next(i for i, word in enumerate(words) if word.startswith("-")):]   # behind the compiler, and what may launch it
        at = words.index("-o")
        run("clang++", "-fsyntax-only", "-Wcomma", "-Wextra-semi-stmt", "-Wheader-hygiene", *words[:at], *words[at + 2:], cwd=one["directory"])
    print(f"ok: clang++ reads {len(commands)} files without a warning")


def upgrade(options, prefix, build, image, generator):
    """Another kbc that is as old as the first one, as packages have it: they keep the time of their making."""
    kbc = os.path.join(prefix, "bin", "kbc")
    then, before = os.stat(kbc).st_mtime_ns, os.stat(image).st_mtime_ns
    with open(kbc, "ab") as file:
        file.write(b"\0")
    os.utime(kbc, ns=(then, then))
    run(options.cmake, "-S", os.path.join(os.path.dirname(build), "project"), "-B", build)
    run(options.cmake, "--build", build, "--target", "bumper_image")
    expect(os.stat(image).st_mtime_ns != before, f"{generator}: after an upgrade of the package, cmake compiles again")


def hand_on(options, prefix, scratch, targets):
    """What a project exports, in the hands of another one."""
    project = os.path.join(scratch, "taker")
    os.makedirs(project, exist_ok=True)
    with open(os.path.join(project, "CMakeLists.txt"), "w", encoding="utf-8") as file:
        file.write("cmake_minimum_required(VERSION 3.16)\nproject(taker LANGUAGES CXX)\nfind_package(Waymark REQUIRED)\n"
                   f"include(\"{targets}\")\nadd_executable(taker \"{os.path.join(HERE, 'inside', 'main.cc')}\")\n"
                   "target_link_libraries(taker PRIVATE handed::bumper_mind)\n")
    run(options.cmake, "-S", project, "-B", os.path.join(project, "build"), f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_COMPILER={options.compiler}")
    print("ok: a knowledge base that a project exports is taken by another one")


def build_where_the_sources_are(options, prefix, scratch):
    project = os.path.join(scratch, "here")
    os.makedirs(project)
    shutil.copy(os.path.join(HERE, "project", "near.kb"), project)
    with open(os.path.join(project, "CMakeLists.txt"), "w", encoding="utf-8") as file:
        file.write("cmake_minimum_required(VERSION 3.16)\nproject(here LANGUAGES CXX)\nfind_package(Waymark REQUIRED)\nkb_add_library(near near.kb)\n")
    done = subprocess.run([options.cmake, ".", f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_COMPILER={options.compiler}"], cwd=project,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    expect(done.returncode != 0 and "build in a folder of its own" in " ".join(done.stdout.split()), "who builds among the sources is told where a file is in the way")


def build_with_make(options, prefix, scratch):
    project = os.path.join(scratch, "project")
    folders = [os.path.join(prefix, lib, "pkgconfig") for lib in ("lib", "lib64", "lib/x86_64-linux-gnu")]
    env = dict(os.environ, PKG_CONFIG_PATH=":".join(folders + [os.environ.get("PKG_CONFIG_PATH", "")]), CXX=options.compiler)
    run("make", f"-j{os.cpu_count() or 2}", f"ROUTE1={options.route1}", cwd=project, env=env)
    out = run(os.path.join(project, "bumper"))
    expect(out.count("\n") == 7, "pkg-config and make: the project builds and drives")


def build_inside(options, prefix, scratch):
    root, build, stage = os.path.dirname(os.path.dirname(HERE)), os.path.join(scratch, "inside"), os.path.join(scratch, "stage")
    run(options.cmake, "-S", os.path.join(HERE, "inside"), "-B", build, f"-DCMAKE_CXX_COMPILER={options.compiler}",
        f"-DWAYMARK={root}", f"-DKBC={os.path.join(prefix, 'bin', 'kbc')}")
    run(options.cmake, "--build", build)
    run(os.path.join(build, "inside"))
    run(options.cmake, "--install", build, "--prefix", stage)
    expect(os.listdir(stage) == ["bin"] and os.listdir(os.path.join(stage, "bin")) == ["inside"],
           "add_subdirectory: the project builds, and installs nothing but its own")


def install_where_debian_does(options, scratch):
    """Below /usr, in a folder of libraries that is deeper than others."""
    root, build, stage = os.path.dirname(os.path.dirname(HERE)), os.path.join(scratch, "deep"), os.path.join(scratch, "deep stage")
    run(options.cmake, "-S", root, "-B", build, "-DWAYMARK_BUILD_COMPILER=OFF", "-DWAYMARK_BUILD_TESTS=OFF", "-DWAYMARK_BUILD_EXAMPLES=OFF",
        f"-DCMAKE_CXX_COMPILER={options.compiler}", "-DCMAKE_INSTALL_PREFIX=/usr", "-DCMAKE_INSTALL_LIBDIR=lib/machine",
        "-DCMAKE_INSTALL_INCLUDEDIR=include/deep")
    run(options.cmake, "--install", build, env=dict(os.environ, DESTDIR=stage))
    env = dict(os.environ, PKG_CONFIG_PATH=os.path.join(stage, "usr/lib/machine/pkgconfig"))
    kbc, headers = (shlex.split(run("pkg-config", f"--variable={name}", "waymark", env=env))[0] for name in ("kbc", "includedir"))
    expect(os.path.normpath(kbc) == os.path.join(stage, "usr/bin/kbc"), "pkg-config finds kbc wherever the libraries are")
    expect(os.path.exists(os.path.join(headers, "waymark/runtime/mind.h")), "pkg-config finds the headers wherever they are")
    with open(os.path.join(stage, "usr/lib/machine/cmake/Waymark/WaymarkTargets.cmake"), encoding="utf-8") as file:
        expect("/include/deep\"" in file.read(), "find_package finds the headers wherever they are")

    project = os.path.join(scratch, "bare")
    os.makedirs(project)
    for path, text in ((os.path.join(project, "robot.cc"), "#include <cstdint>\n#include <waymark/runtime/mind.h>\n"),
                       (os.path.join(stage, "usr/include/deep/stdint.h"), "#error of another machine\n")):
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    with open(os.path.join(project, "CMakeLists.txt"), "w", encoding="utf-8") as file:
        file.write("cmake_minimum_required(VERSION 3.25)\nproject(bare LANGUAGES CXX)\n"
                   "set(CMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH OFF)\nset(CMAKE_FIND_USE_CMAKE_SYSTEM_PATH OFF)   # it may have a kbc\n"
                   "find_package(Waymark REQUIRED COMPONENTS ${PARTS})\nif(NOT TARGET Waymark::kbc)\n  message(STATUS \"no kbc\")\nendif()\n"
                   "add_library(robot robot.cc)\ntarget_link_libraries(robot Waymark::runtime)\n")
    command = [options.cmake, "-S", project, "-B", os.path.join(project, "build"), f"-DWaymark_DIR={stage}/usr/lib/machine/cmake/Waymark",
               f"-DCMAKE_CXX_COMPILER={options.compiler}"]
    expect("no kbc" in run(*command, "-DPARTS=runtime;fleet"), "a runtime without kbc is found")
    run(*command, "-B", os.path.join(project, "cross"), "-DPARTS=runtime", "-DCMAKE_SYSTEM_NAME=Generic")
    run(options.cmake, "--build", os.path.join(project, "cross"))
    print("ok: another machine's compiler finds the headers, and no others of this machine")
    done = subprocess.run(command + ["-DPARTS=kbc"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    expect(done.returncode != 0 and "there is no Waymark::kbc" in done.stdout, "who asks for kbc is told that there is none")


def package_for_debian(options, scratch):
    cpack, folder = os.path.join(os.path.dirname(shutil.which(options.cmake)), "cpack"), os.path.join(scratch, "debian")
    mask = os.umask(0o077)   # as some machines' root has it
    run(cpack, "-G", "DEB", "-B", folder, cwd=options.build)
    os.umask(mask)
    names = sorted(name for name in os.listdir(folder) if name.endswith(".deb"))
    expect(names and names[-1].startswith("waymark_"), f"Debian packages: {', '.join(names)}")
    package = os.path.join(folder, names[-1])
    told = {field: run("dpkg-deb", "--field", package, field).strip() for field in ("Package", "Depends")}
    expect(told["Package"] == "waymark" and "libbox2d" in told["Depends"] and "mpi" not in told["Depends"], "it depends on what kbc is linked with, and not on MPI")
    expect("drwx---" not in run("dpkg-deb", "--contents", package), "all users may enter its folders")
    run("dpkg-deb", "--extract", package, os.path.join(folder, "root"))
    kbc = os.path.join(folder, "root/usr/bin/kbc")
    run(kbc, "new", os.path.join(folder, "robot"))
    run(kbc, "test", os.path.join(folder, "robot/tests"))
    print("ok: its kbc finds the library, makes a project and tests it")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    for name in ("build", "route1", "cmake", "compiler"):
        parser.add_argument("--" + name, required=True)
    options = parser.parse_args()
    os.environ.pop("WAYMARK_LIBRARY", None)

    scratch = os.path.join(options.build, "install_test")
    # Where ccache is used, what one generator has compiled the other one need not: the same bytes in another folder.
    os.environ.update(CCACHE_BASEDIR=scratch, CCACHE_NOHASHDIR="1")
    shutil.rmtree(scratch, ignore_errors=True)
    first, prefix = os.path.join(scratch, "first"), os.path.join(scratch, "moved")
    run(options.cmake, "--install", options.build, "--prefix", first)
    shutil.move(first, prefix)
    shutil.copytree(os.path.join(HERE, "project"), os.path.join(scratch, "project"))

    for path in ("bin/kbc", "include/waymark/runtime/mind.h", "share/waymark/stdlib_rules/std/navigation.kb",
                 "share/man/man1/kbc.1", "share/bash-completion/completions/kbc", "share/fish/vendor_completions.d/kbc.fish",
                 "share/zsh/vendor-completions/_kbc"):
        expect(os.path.getsize(os.path.join(prefix, path)) > 0, f"installed: {path}")
    build_with_cmake(options, prefix, scratch, "Unix Makefiles")
    build_with_cmake(options, prefix, scratch, "Ninja")
    build_where_the_sources_are(options, prefix, scratch)
    build_with_make(options, prefix, scratch)   # optimised; the last: its files lie in the project's folder
    build_inside(options, prefix, scratch)
    install_where_debian_does(options, scratch)
    package_for_debian(options, scratch)
    print("install: all is well")
    return 0


if __name__ == "__main__":
    sys.exit(main())
