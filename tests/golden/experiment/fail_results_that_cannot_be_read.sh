# RUN: mkdir %t/out; ln -s /proc/self/mem %t/out/runs.part; cd %t; kbc experiment --out out --scenarios 2 --labyrinths 1
