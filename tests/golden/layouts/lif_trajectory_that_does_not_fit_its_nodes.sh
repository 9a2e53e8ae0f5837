# RUN: kbc import lif ../../../data/layouts/lif/17-edge-with-trajectory-definition.json
