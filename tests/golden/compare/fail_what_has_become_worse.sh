# RUN: cd what_a_change_did_to_each_run.d && kbc compare before after --expect "lost=0,collisions=0,gained>=2" > /dev/null
# RUN: cd what_a_change_did_to_each_run.d && kbc compare before after --expect "lost<=1,gained>=0,bans_broken<=1,lost_unaware<=20%,standing_contacts=0" > /dev/null && echo passes
# RUN: cd what_a_change_did_to_each_run.d && kbc compare before after --expect "arrived>=95%"
