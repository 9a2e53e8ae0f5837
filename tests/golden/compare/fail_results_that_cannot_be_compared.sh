# RUN: cd what_a_change_did_to_each_run.d && sed '5s/,arrived,/,gone,/' before/runs.csv > %t/row.csv && kbc compare %t/row.csv after
# RUN: cd what_a_change_did_to_each_run.d && sed '5s/,0,0.00,/,/' before/runs.csv > %t/short.csv && kbc compare before %t/short.csv
# RUN: cd what_a_change_did_to_each_run.d && sed 's/outcome/result/' before/runs.csv > %t/names.csv && kbc compare before %t/names.csv
# RUN: cd what_a_change_did_to_each_run.d && sed 's/impact_m_s/impact/' before/runs.csv > %t/measures.csv && kbc compare before %t/measures.csv
# RUN: echo '# nothing' > %t/empty.csv && kbc compare %t/empty.csv %t/empty.csv
# RUN: cd what_a_change_did_to_each_run.d && sed 's/,robot.speed,/,robot.turn,/' before/runs.csv > %t/other.csv && kbc compare before %t/other.csv
# RUN: cd what_a_change_did_to_each_run.d && sed 's/^crate,/box,/;s/^closed,/shut,/' before/runs.csv > %t/apart.csv && kbc compare before %t/apart.csv
# RUN: cd what_a_change_did_to_each_run.d && sed '$p' after/runs.csv > %t/twice.csv && kbc compare before %t/twice.csv
# RUN: cd what_a_change_did_to_each_run.d && sed '$p' after/runs.csv > %t/twice.csv && kbc compare %t/twice.csv after
# RUN: kbc compare - -
# RUN: kbc compare what_a_change_did_to_each_run.d/before what_a_change_did_to_each_run.d/after --csv -
# RUN: kbc compare what_a_change_did_to_each_run.d/before
# RUN: kbc compare what_a_change_did_to_each_run.d/before nowhere
# RUN: kbc compare what_a_change_did_to_each_run.d/before --between 0.4,0.6
# RUN: kbc compare what_a_change_did_to_each_run.d/before --between robot.speed=0.4
# RUN: kbc compare what_a_change_did_to_each_run.d/before --between robot.speed=0.4,0.5
# RUN: kbc compare what_a_change_did_to_each_run.d/before --between method=mts,bug2
# RUN: cd what_a_change_did_to_each_run.d && kbc compare before after --csv before/runs.csv
