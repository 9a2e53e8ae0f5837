# RUN: printf '# only a comment\n\n' > %t/none.csv; kbc tidy %t/none.csv; printf 't,A\n0,1\n' > %t/a.csv; kbc tidy %t/a.csv -o %t/a.csv; kbc tidy %t/missing.csv; kbc tidy %t/a.csv --clock forwards
