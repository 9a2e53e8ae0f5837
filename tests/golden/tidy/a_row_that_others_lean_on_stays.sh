# RUN: printf '# empty: as before\nt,Wall,Line\n0.2,1,\n0.1,,1\n0.3,,\n' > %t/lean.csv; kbc tidy %t/lean.csv; kbc tidy --clock sort %t/lean.csv; kbc tidy --clock shift %t/lean.csv
