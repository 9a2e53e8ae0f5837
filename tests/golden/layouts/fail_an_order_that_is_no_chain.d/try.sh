# A name, nodes, edges, and perhaps a version: an order of them for the plant of the case beside this one.
echo "{\"orderId\":\"$1\",\"orderUpdateId\":0,\"nodes\":[$2],\"edges\":[$3]${4:+,\"version\":\"$4\"}}" |
  kbc import lif an_order_is_driven_by_its_own_edges.d/plant.json --order -
