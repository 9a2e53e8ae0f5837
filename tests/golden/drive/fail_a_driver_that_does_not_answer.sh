# RUN: kbc sim session.d/works.kb -w --driver-timeout 4s --driver 'read senses; echo "{\"speed\":0,\"turn\":0}"; exec sleep 300'
