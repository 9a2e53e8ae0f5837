# RUN: kbc compare what_a_change_did_to_each_run.d/before --between robot.speed=0.4,0.6,0.8
