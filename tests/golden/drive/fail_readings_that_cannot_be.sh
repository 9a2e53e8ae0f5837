# RUN: kbc drive session.d/scale.kb < session.d/odd_readings.jsonl
