# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --scenario ../../../examples/04_simulator/abort.toml --seeds 1-2 --out %t/results --expect "arrived>=95%, collisions=0" -q > /dev/null && echo passes
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --set limit=40,300 --seeds 1-3 --out %t/sweep --expect "arrived>=95%,time_up<1,silent<=50%"
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/detour.toml --set limit=40,300 --seeds 1-3 --out %t/sweep --expect "arrived>=0,missed<=3" -q > /dev/null && echo passes by the results that are there
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/none --expect arrived
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/none --expect "arives>=95%"
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/none --expect "arrived>=950%"
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/none --expect "arrived>=0.95"
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/none --expect "arrived>=95.0000000001%"
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/none --expect "arrived>=few,collisions=0"
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/none --expect "arrived>=1," ; test ! -e %t/none && echo nothing was driven
# RUN: kbc fleet ../../../examples/04_simulator/route1.kb --out %t/none --expect "arrived>=1" --shard 1/2
