# RUN: for t in 1 1.02 1.04; do echo "{\"t\":$t,\"vehicle\":{\"battery\":80},\"actions\":[]}"; done | kbc drive session.d/works.kb | grep -c '"error"'; test $? = 1
