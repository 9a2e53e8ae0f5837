# RUN: cd %t && kbc experiment --out results --scenarios 2 --labyrinths 2 -q > /dev/null && kbc experiment --out results --scenarios 2 --labyrinths 2 --seed 2
# RUN: cd %t && kbc experiment --out results --scenarios 2 --labyrinths 2 --method mts -q > /dev/null && sed -i '1s/[0-9a-f]\{16\}/0123456789abcdef/' results/runs.csv && kbc experiment --out results --scenarios 2 --labyrinths 2 --method mts
