# RUN: kbc drive session.d/works.kb -w --record %t/drive.jsonl < session.d/senses.jsonl > %t/first; kbc drive session.d/works.kb -w < %t/drive.jsonl | cmp - %t/first && head -c 400 %t/drive.jsonl
