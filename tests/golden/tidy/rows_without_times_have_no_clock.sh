# RUN: printf 'Wall\n0\n1\n' > %t/ticks.csv; kbc tidy %t/ticks.csv
