# RUN: cd %t && kbc experiment --out results --scenarios 2 --labyrinths 2 -q > /dev/null && kbc experiment --out results --scenarios 2 --labyrinths 2 --seed 2
