# RUN: kbc sim ../../../examples/07_open_hall/bug.kb --scale 5e7
