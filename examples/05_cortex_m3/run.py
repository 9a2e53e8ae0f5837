#!/usr/bin/env python3
"""Runs mission.elf in qemu-system-arm and checks what it says.

    run.py MISSION.ELF [--host mission_on_host] [--size arm-none-eabi-size] [--text N] [--memory N] [--event N] [--page README.md]

With --host, the microcontroller must have decided what the host decides: the same hashes. With limits, the bytes of flash
(code, constants, table of vectors; without the recording), the bytes of memory (data and the stack that was used), and the
mean number of instructions of an event tick must not be above them. Runs twice: counts in emulation are exact, so both runs
must print the same. With --page, every line must also stand in that page.
"""
import argparse
import re
import subprocess
import sys

QEMU = ["qemu-system-arm", "-M", "mps2-an385", "-nographic", "-monitor", "none", "-serial", "none",
        "-semihosting-config", "enable=on,target=native", "-icount", "shift=6", "-kernel"]


def emulate(elf):
    try:
        done = subprocess.run(QEMU + [elf], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120, check=False)
    except subprocess.TimeoutExpired as late:
        sys.exit(f"it does not end; is the stack large enough?\n{(late.stderr or b'').decode()}")
    text = done.stdout + done.stderr      # semihosting prints on the error stream
    if done.returncode != 0:
        sys.exit(f"qemu ended with {done.returncode}\n{text}")
    return text


def sections(size, elf):
    rows = subprocess.run([size, "-A", elf], capture_output=True, text=True, check=True).stdout
    return {name: int(n) for name, n in re.findall(r"^(\.\S+)\s+(\d+)", rows, re.M)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("elf")
    parser.add_argument("--host", help="the same mission on this machine")
    parser.add_argument("--size", default="arm-none-eabi-size", help="the program that counts bytes")
    parser.add_argument("--text", type=int, help="most bytes of flash")
    parser.add_argument("--memory", type=int, help="most bytes of memory, with the stack")
    parser.add_argument("--event", type=int, help="most instructions of an event tick, in the mean")
    parser.add_argument("--page", help="a page that shows what is printed here")
    options = parser.parse_args()
    said = emulate(options.elf)
    faults = [] if emulate(options.elf) == said else ["two runs differ"]
    part = sections(options.size, options.elf)
    flash = part[".text"] + part[".rodata"] + part[".data"]
    stack = max(int(n) for n in re.findall(r"^stack (\d+)", said, re.M))
    memory = part[".data"] + part[".bss"] + stack
    event = int(re.search(r"^ +event +\d+ +\d+ +(\d+)", said, re.M)[1])
    told = said.strip() + f"""
flash {flash} bytes: {part['.text']} of code, {part['.rodata']} of constants; the recording {part['.recording']} apart
memory {memory} bytes: {part['.bss'] + part['.data']} of data, {stack} of stack"""
    print(told)

    if options.host:
        host = subprocess.run([options.host], capture_output=True, text=True, check=True).stdout
        for line in host.splitlines():
            if line not in said.splitlines():
                faults.append(f"the host says `{line}`")
    for name, value, most in (("flash", flash, options.text), ("memory", memory, options.memory),
                              ("instructions of an event tick", event, options.event)):
        if most is not None and value > most:
            faults.append(f"{name}: {value}, allowed {most}")
    if options.page:
        with open(options.page, encoding="utf-8") as page:
            shown = page.read().splitlines()
        faults += [f"{options.page} does not show `{line}`" for line in told.splitlines() if line not in shown]
    print("\n".join([f"fault: {f}" for f in faults] + [f"{len(faults)} faults"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
