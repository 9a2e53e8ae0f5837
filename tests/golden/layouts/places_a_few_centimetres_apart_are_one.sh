# RUN: kbc import lif %d/plant.json | grep "landmark\|road "
