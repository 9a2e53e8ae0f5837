# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out ""
# RUN: kbc experiment --out ""
# RUN: kbc experiment --out %t/results --jobs 1000000000
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results --jobs 0
# RUN: kbc plan --from 1,1 --to 2,2
# RUN: kbc plan map.map --scen map.scen --threads 1000000000
