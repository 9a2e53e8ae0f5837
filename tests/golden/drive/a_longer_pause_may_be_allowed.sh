# RUN: printf '{"t":0}\n{"t":0.9}\n' | kbc drive session.d/works.kb -w --pause 1s
