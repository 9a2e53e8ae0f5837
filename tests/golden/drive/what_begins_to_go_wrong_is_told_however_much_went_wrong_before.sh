# RUN LONG: python3 lines.d/weeks.py | kbc drive session.d/works.kb -w > /dev/null 2> %t/errors; echo exit $?; grep -o 'KB[0-9]*' %t/errors | sort | uniq -c; grep -A 1 -m 1 KB1373 %t/errors; tail -n 2 %t/errors
# RUN: python3 lines.d/weeks.py | kbc drive session.d/works.kb > /dev/null 2> %t/errors; echo exit $?; grep -o 'KB[0-9]*' %t/errors | sort | uniq -c
# RUN: (head -c 3000000 /dev/zero | tr '\0' '\n'; echo '{"t":1,"range_m":[4]}') | (kbc drive session.d/works.kb > /dev/null; echo exit $?)
