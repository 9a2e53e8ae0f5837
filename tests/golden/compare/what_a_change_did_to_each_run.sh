# RUN: cd what_a_change_did_to_each_run.d && kbc compare before after --csv %t/pairs.csv
# RUN: head -n 3 %t/pairs.csv
# RUN: cd what_a_change_did_to_each_run.d && kbc compare before/runs.csv after/runs.csv --most 1
# RUN: cd what_a_change_did_to_each_run.d && kbc compare before before
# RUN: cd what_a_change_did_to_each_run.d && tr -d '\r' < after/runs.csv | sed 's/$/\r/' > %t/crlf.csv && kbc compare before %t/crlf.csv | tail -n +2 | diff - <(kbc compare before after | tail -n +2) && echo line ends do not matter
