# RUN: printf '<model name="A" name="B"/>' | kbc import opentcs -
# RUN: printf '<model name="A">\n</model>\n<model name="B"/>\n' | kbc import opentcs -
# RUN: printf '<model name="A">\n</model>\nmore\n' | kbc import opentcs -
# RUN: printf '<model name="A">\n  <point name="&depot;"/>\n</model>\n' | kbc import opentcs -
# RUN: printf '<model name="A">\n  <point name="\377"/>\n</model>\n' | kbc import opentcs -
# RUN: printf '<?xml version="1.0" encoding="ISO-8859-1"?>\n<model name="\351" name="B"/>\n' | kbc import opentcs -
# RUN: printf '' | kbc import opentcs -
