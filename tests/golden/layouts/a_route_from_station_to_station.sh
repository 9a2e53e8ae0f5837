# RUN: kbc import opentcs ../../../data/layouts/opentcs/Demo-01.xml -w --route 'Goods in north 01,Storage 01' | grep -A 2 '^route'
# RUN: kbc import lif ../../../data/layouts/lif/08-station-with-two-nodes-restricted-for-different-ve.json -w --vehicle Vehicle_Type_1 --route N1,S01 | grep -A 1 '^route'
