# RUN: source %s %t
# Each message says what to write instead.
readonly town=fail_a_scenario_that_is_no_toml.kb scenario="$1/s.toml"
try() { printf "$1\n" > "$scenario"; kbc sim $town --scenario "$scenario"; }
try '[[event]]\nwhen = { leg = “Inn>Mill” }\nclose = "Inn.E"'
try '[[event]]\nwhen = { leg = Inn>Mill }\nclose = "Inn.E"'
try '[[event]]\nwhen = "Inn>Mill"\nclose = "Inn.E"'
try '[[event]]\nwhen = { leg = "Inn>Mill", delay = "3,5 s" }\nclose = "Inn.E"'
try '[[event]]\nwhen = { time = 1 }\nclose = "Inn.E"\nclose = "Mill.W"'
try '[[event]]\nwhen = { time = 3 s }\nclose = "Inn.E"'
try '[[event]]\nwhen = { time = 3 }\nclose = "Inn"'
try '[robot]\nspeed = 0,3'
try '[robot]\nspeed = 0.3\n[robot]\nturn = 2'
try '[robot]\nspeed: 0.3'
try '[robot]\nspeed = 0.3;'
try '[robot]\nspeed ='
try 'open_end = True'
try '// closed'
try 'speed = 0.3'
kbc sim $town --set speed=0.3
kbc sim $town s.toml
kbc sim $town —scenario s.toml
kbc check $town -werror
