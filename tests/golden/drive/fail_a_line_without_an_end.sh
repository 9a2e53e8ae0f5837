# RUN: python3 -c 'print("{\"t\":0}"); print("[" * 300000); print("{\"t\":0.02}"); print("x" * 270000, end="")' | kbc drive session.d/works.kb -w
