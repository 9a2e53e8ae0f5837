# RUN: cd %t && kbc experiment --out results --scenarios 2 --labyrinths 2 --library nowhere
