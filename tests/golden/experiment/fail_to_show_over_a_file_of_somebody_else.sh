# RUN: cd %t && kbc experiment --out files --scenarios 4 --labyrinths 2 --show 1 && kbc experiment --out files --scenarios 4 --labyrinths 2 --show 1 && head -1 files/mission.kb
# RUN: cd %t && mkdir mine && echo "fact Mine" > mine/mission.kb && kbc experiment --out mine --scenarios 4 --labyrinths 2 --show 1 -q 2> /dev/null || grep . mine/*
# RUN: cd %t && kbc experiment --out mine --scenarios 4 --labyrinths 2 --show 1
