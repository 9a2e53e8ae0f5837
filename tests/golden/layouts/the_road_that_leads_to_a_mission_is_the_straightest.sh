# RUN: kbc import lif %d/one_way.json --route B,C --trim > %t/a.kb; grep -E "landmark|road " %t/a.kb; kbc sim %t/a.kb
