# RUN: kbc sim session.d/works.kb -w --driver "exec ./no_such_program 2>/dev/null"
