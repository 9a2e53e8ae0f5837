# RUN: (echo t,Line; seq -f '%.0f,1' 1 100000000) | kbc tidy - > /dev/full; echo $?; (echo t,Line; seq -f '%.0f,1' 1 100000000) | kbc tidy - -o /dev/full
