# RUN: kbc import opentcs %d/names.xml --route Start,Line > %t/a.kb; cat %t/a.kb; kbc check %t/a.kb
