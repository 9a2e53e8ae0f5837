# RUN: kbc import lif %d/plant.json | sed -n '/landmark/d;/map/,/}/p'
