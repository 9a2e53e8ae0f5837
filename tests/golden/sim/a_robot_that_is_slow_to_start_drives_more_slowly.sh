# RUN: for a in 1.5 0.3 0.1; do echo "-- $a m/s2"; kbc sim ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/plain.toml --set limit=600 --set robot.acceleration=$a; done
# RUN: kbc sim ../../../examples/04_simulator/route1.kb --scenario ../../../examples/04_simulator/plain.toml --set limit=600 --set robot.turn=0.3 --set robot.speed=0.1
