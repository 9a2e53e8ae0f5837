# RUN: printf '{"t":0,"facts":{"\\u001b[2J":"x"}}\n' | kbc drive session.d/works.kb -w
