# RUN: printf '{"t":5}\n{"t":5}\n{"t":4.9}\n{"t":5.02}\n' | kbc drive session.d/works.kb -w
