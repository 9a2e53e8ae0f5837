# RUN LONG: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --mind %d/nowhere.kb
# RUN: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --mind %d/broken.kb
# RUN: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --mind %d/mapped.kb
# RUN: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --mind %d/slow.kb=bug2
# RUN: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --mind "%d/slow.kb=two words"
# RUN: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --mind %d/slow.kb=nan
# RUN: mkdir '%t/a"b' && cp %d/slow.kb '%t/a"b/c d.kb' && cd %t && kbc experiment --out results --scenarios 2 --labyrinths 2 --seed 3 --mind 'a"b/c d.kb=cd'
# RUN: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --mind %d/slow.kb --mind %d/lost.kb=slow
# RUN: kbc experiment --out %t/results --scenarios 2 --labyrinths 2 --seed 3 --mind %d/slow.kb --method slwo
# RUN: kbc experiment --out %t/results --scenarios 3 --labyrinths 3 --seed 1 --mind %d/lost.kb -q
# RUN: cp -r %d %t/minds && cd %t && kbc experiment --out again --scenarios 2 --labyrinths 2 --seed 3 --mind minds/slow.kb -q > /dev/null && echo "# changed" >> minds/slow.kb && kbc experiment --out again --scenarios 2 --labyrinths 2 --seed 3 --mind minds/slow.kb
