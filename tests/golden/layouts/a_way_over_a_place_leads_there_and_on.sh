# RUN: kbc import lif %d/plant.json --order %d/order.json -o %t/a.kb; sed -n '/^map/,/^    Dock/p' %t/a.kb; kbc sim %t/a.kb
# RUN: kbc import lif %d/plant.json -w --route Dock,Shelf2 | sed -n '/^route/,/^    Dock/p'
