# RUN: printf '{"t":1,"readings":{"load":65535}}\n{"t":1.02,"readings":{"load":-1}}\n{"t":1.04,"readings":{"load":null}}\n' | kbc drive session.d/scale.kb | cut -c 1-30
