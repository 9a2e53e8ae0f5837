# RUN: printf '<model>\n  <point name="A" positionX="5 m" positionY="1"/>\n  <point name="B" positionX="1"/>\n</model>' | kbc import opentcs -
