# RUN: sh fail_an_order_that_is_no_chain.d/try.sh renamed '{"nodeId":"Dock","sequenceId":0,"released":true},{"nodeId":"Gate","sequenceId":2,"released":true}' '{"edgeId":"into","sequenceId":1,"released":true}'
# RUN: sh fail_an_order_that_is_no_chain.d/try.sh no_such_road '{"nodeId":"Dock","sequenceId":0,"released":true},{"nodeId":"Shelf","sequenceId":2,"released":true}' '{"edgeId":"near","sequenceId":1,"released":true}'
# RUN: sh fail_an_order_that_is_no_chain.d/try.sh elsewhere '{"nodeId":"Dock","sequenceId":0,"released":true},{"nodeId":"Yard","sequenceId":2,"released":true}' '{"edgeId":"in","sequenceId":1,"released":true}'
# RUN: kbc import lif an_order_is_driven_by_its_own_edges.d/plant.json --order no_such_order.json
# RUN: kbc import lif - --order - < /dev/null
# RUN: kbc import lif an_order_is_driven_by_its_own_edges.d/plant.json --order an_order_is_driven_by_its_own_edges.d/order.json --route Dock
# RUN: kbc import fll - --order an_order_is_driven_by_its_own_edges.d/order.json < /dev/null
# RUN: sh fail_an_order_that_is_no_chain.d/try.sh without_an_id '{"nodeId":"Dock","sequenceId":0,"released":true},{"nodeId":"Gate","sequenceId":2,"released":true}' '{"edgeId":"","sequenceId":1,"released":true}'
# RUN: kbc import lif an_order_is_driven_by_its_own_edges.d/plant.json --order "" --trim
