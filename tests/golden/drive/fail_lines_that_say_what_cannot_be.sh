# RUN: kbc drive session.d/works.kb -w < odd_lines.jsonl
