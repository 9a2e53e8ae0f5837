# RUN: cd %t && kbc experiment --out files --scenarios 4 --labyrinths 2 --show 4
