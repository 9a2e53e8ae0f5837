# RUN: kbc drive session.d/works.kb -w --set sensors.range.rate=1e-300 --describe | grep latency
