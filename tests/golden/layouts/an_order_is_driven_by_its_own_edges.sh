# RUN: kbc import lif %d/plant.json --order %d/order.json -o %t/order.kb; cat %t/order.kb; kbc check %t/order.kb && kbc sim %t/order.kb
