# RUN: kbc sim works.d/works.kb --set sensors.line.rate=0
