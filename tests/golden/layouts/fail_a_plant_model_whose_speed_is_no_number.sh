# RUN: kbc import opentcs %d/model.xml
