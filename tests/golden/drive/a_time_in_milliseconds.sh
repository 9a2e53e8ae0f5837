# RUN: for t in 5000 5020 5040 5060 5080 5100 5120; do echo "{\"t\":$t}"; done | kbc drive session.d/works.kb | grep -o '"t":[^,]*\|"waits":true'
