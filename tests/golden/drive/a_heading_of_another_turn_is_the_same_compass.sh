# RUN: for rad in 1.4831853 -4.8; do (echo "{\"t\":0,\"compass_rad\":$rad}"; echo '{"t":0.02}') | kbc drive session.d/compass.kb -w | grep -o '"fired":[^]]*]'; done
