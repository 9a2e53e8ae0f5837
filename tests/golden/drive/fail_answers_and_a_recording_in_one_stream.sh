# RUN: kbc drive session.d/works.kb --record - < /dev/null
