# RUN: kbc sim ../../../examples/04_simulator/route1.kb --html /dev/full --csv %t/drive.csv; kbc_ended=$?; wc -l < %t/drive.csv; exit $kbc_ended
