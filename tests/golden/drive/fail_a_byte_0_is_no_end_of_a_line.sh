# RUN: printf '{"t":0}\0{"t":1}\n{"t":0,"buttons":["\0"]}\n' | kbc drive session.d/works.kb -w
