# RUN: cp %s %t/spoils.py; cd %t; printf 'import std.navigation\nmap Town {\n landmark Inn at (0, 0)\n landmark Well at (3, 0)\n landmark Mill at (6, 0)\n road Inn.E -- Well.W by mark\n road Well.E -- Mill.W by mark\n}\ncommand Go\nroute Errand on Town by Go: Well -> Mill\n' > town.kb; kbc sim town.kb -w --driver "python3 spoils.py" | head -3
# A line that `kbc drive` refuses is answered without `mission`: the robot stands for a moment, and its mission goes on.
import subprocess
import sys

mind = subprocess.Popen(["kbc", "drive", "town.kb", "-w"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
for number, line in enumerate(sys.stdin):
    mind.stdin.write(line if number != 300 else line.replace('"touched"', '"tuched"'))
    mind.stdin.flush()
    print(mind.stdout.readline(), end="", flush=True)
