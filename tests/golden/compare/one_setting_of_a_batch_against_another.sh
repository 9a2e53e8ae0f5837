# RUN: kbc compare what_a_change_did_to_each_run.d/after --between robot.speed=0.4,0.6
# RUN: cd what_a_change_did_to_each_run.d && kbc compare before after --between robot.speed=0.6,0.4
