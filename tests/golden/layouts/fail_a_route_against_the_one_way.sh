# RUN: kbc import opentcs ../../../data/layouts/opentcs/PlantModelV7.sample.xml -w --route Point-0002,Point_0001
