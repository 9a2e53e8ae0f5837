# RUN: cp "$(command -v kbc)" %t/kbc && OMPI_COMM_WORLD_SIZE=2 %t/kbc fleet ../../../examples/04_simulator/route1.kb --out %t/results
