# RUN LONG: cd %t && kbc experiment --out lab --scenarios 8 --labyrinths 2 --seed 3 -q > /dev/null && kbc compare lab --between method=mts,bug2
# RUN: cd %t && kbc experiment --out again --scenarios 8 --labyrinths 2 --seed 3 --method mts --method bug2 -q > /dev/null; kbc compare lab again | sed 's/^OLD is.*//'
