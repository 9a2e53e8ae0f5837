# RUN: kbc sim session.d/works.kb -w --dt 30ms --driver "kbc drive session.d/works.kb"
