# RUN: (ulimit -f 0; trap '' XFSZ; kbc fleet ../../../examples/04_simulator/route1.kb --out %t/full --seeds 1-8 --jobs 1 -q); echo exit $?; ls %t/full/shards
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/full --seeds 1-8 -q > /dev/null && kbc fleet ../../../examples/04_simulator/route1.kb --out %t/whole --seeds 1-8 -q > /dev/null && diff -r %t/full %t/whole && echo the same
