# RUN: kbc experiment --scenarios 1000000 --set sensors.range.noise=0.01,0.02,0.03,0.04 --out %t/results
