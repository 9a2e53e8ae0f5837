# RUN: kbc import opentcs %d/model.xml
# RUN: kbc import opentcs %d/older.xml
