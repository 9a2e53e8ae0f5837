# RUN: kbc sim ../../../examples/04_simulator/route1.kb --html - --csv %t/drive.csv > /dev/full; kbc_ended=$?; wc -l < %t/drive.csv; exit $kbc_ended
