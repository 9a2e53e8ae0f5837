# RUN: kbc sim session.d/works.kb -w --driver "python3 session.d/line.py tells" --set limit=40 --expect "arrived at Store"; echo $?
