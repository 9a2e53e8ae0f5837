# RUN: kbc import opentcs ../../../data/layouts/opentcs/PlantModelV7.sample.xml -Wno-layout-adapted | tail -1
