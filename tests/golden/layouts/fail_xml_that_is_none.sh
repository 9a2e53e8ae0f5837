# RUN: printf '<model>\n  <point name="A" </model>' | kbc import opentcs -
