# RUN: printf '<plant/>' | kbc import opentcs -
