# RUN: kbc sim session.d/works.kb -w --facts %t/f.csv --driver "kbc drive session.d/works.kb"
