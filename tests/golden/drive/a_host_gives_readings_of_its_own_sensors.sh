# RUN: kbc drive session.d/scale.kb < session.d/readings.jsonl | grep -o '"cf".*'; kbc drive session.d/scale.kb --describe | sed -n '/sensors_of_the_host/,/^  .,/p'
