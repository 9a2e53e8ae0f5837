# RUN: printf '{"t":0}\n{"t":0.45}\n{"t":1}\n{"t":1.1}\n{"t":1.2,"buttons":["Go"]}\n{"t":1.3}\n' | kbc drive session.d/works.kb -w | cut -c 1-190
