# RUN: printf 'P5 2 1 255x\377\377' > %t/a.pgm && printf 'image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\n' > %t/a.yaml && kbc plan %t/a.yaml --from 0.5,0.5 --to 1.5,0.5
