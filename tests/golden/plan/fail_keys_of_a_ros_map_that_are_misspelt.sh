# RUN: printf 'P2\n3 1\n255\n215 215 215\n' > %t/a.pgm; printf 'image: a.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nfree_tresh: 0.1\nauthor: somebody\n' > %t/b.yaml; cd %t && kbc plan b.yaml --from 0.05,0.05 --to 0.25,0.05
# RUN: printf 'image: a.pgm\nresolution: 0.1\norigin: [0, 0, 0]\noccupied_thresh: 0.1\nfree_thresh: 0.9\n' > %t/b.yaml; cd %t && kbc plan b.yaml --from 0.05,0.05 --to 0.25,0.05
