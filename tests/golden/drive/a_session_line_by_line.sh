# RUN: kbc drive session.d/works.kb -w < session.d/senses.jsonl
