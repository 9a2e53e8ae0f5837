# RUN: kbc sim session.d/works.kb -w --driver "python3 session.d/line.py repeats"
