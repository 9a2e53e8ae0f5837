# RUN: kbc import opentcs ../../../data/layouts/opentcs/PlantModelV7.sample.xml --map Hall --by azimuth
