# RUN: kbc drive session.d/works.kb -w --set robot.speed=0.3,0.4 < /dev/null
