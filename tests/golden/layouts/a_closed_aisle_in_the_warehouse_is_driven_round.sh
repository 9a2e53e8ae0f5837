# RUN LONG: kbc check ../../../examples/08_plant/mission.kb; kbc sim ../../../examples/08_plant/mission.kb --scenario ../../../examples/08_plant/closed.toml
