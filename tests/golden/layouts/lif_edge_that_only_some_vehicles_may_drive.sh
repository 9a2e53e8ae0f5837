# RUN: kbc import lif %d/plant.json | grep "road "
# RUN: kbc import lif %d/plant.json --vehicle Acme.Tug | grep "road "
