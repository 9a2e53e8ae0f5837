# RUN: kbc drive session.d/works.kb -w --describe --set robot.speed=0.3 --set sensors.range.rate=10
