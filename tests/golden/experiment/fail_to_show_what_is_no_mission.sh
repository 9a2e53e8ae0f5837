# RUN: kbc experiment --out %t/files --scenarios 4 --labyrinths 2 --show 1 --method bug2; ls %t
# RUN: kbc experiment --out %t/files --scenarios 4 --labyrinths 2 --show 1 --method mts --method programmed; ls %t
# RUN: kbc experiment --out %t/files --scenarios 4 --labyrinths 2 --show 1 --set robot.size=2,4
