# RUN LONG: for way in Point-0004,Point-0060 Point-0017,Point-0044 Point-0049,Point-0015; do kbc import opentcs ../../../data/layouts/opentcs/Demo-01.xml --route $way --trim -o %t/a.kb && kbc sim -w %t/a.kb --set limit=2000; done
# RUN: kbc import opentcs ../../../data/layouts/opentcs/Demo-01.xml --route Point-0055,Point-0021 -o %t/a.kb; kbc sim %t/a.kb; kbc sim -w %t/a.kb --set limit=1000
