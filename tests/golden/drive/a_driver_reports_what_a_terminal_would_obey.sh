# RUN: kbc sim session.d/works.kb -w --set limit=2 --driver "python3 session.d/line.py shouts" | head -1
