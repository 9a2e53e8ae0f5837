# RUN: kbc sim session.d/works.kb -w --scenario session.d/seen.toml --expect "stopped: Driver.ended" --driver "python3 session.d/line.py dies_seeing"
