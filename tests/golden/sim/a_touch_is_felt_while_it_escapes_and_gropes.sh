# RUN: bash %s %t
# The bumper stands the robot before anything else begins, and it goes on when it is free.
rules() { grep -oE '"t":[0-9.]+|"fired":[^]]*' $1 | paste - - | grep -E 'feel|come_free|relieve'; }
cd ../../../examples/07_open_hall
press() { printf '[[event]]\nwhen = { time = 1 }\npress = "Go"\n[[event]]\nwhen = { strategy = "%s", delay = 0.5 }\npress = "Touched"\nfor = 4\n' $1; }
{ cat trap.toml; press Escape; } > $1/trap.toml
kbc sim potential.kb --scenario $1/trap.toml --trace $1/trap.jsonl --expect arrived
rules $1/trap.jsonl
cat > $1/town.kb <<'EOF'
import std.navigation
import std.recover

map Town {
    landmark Inn  at (0, 0)
    landmark Mill at (4, 0)
    landmark Well at (8, 0)
    road Inn.E  -- Mill.W by mark
    road Mill.E -- Well.W by mark
}
command Go
route Errand on Town by Go: Well -> Mill -> Inn
EOF
{ press Grope.forward; printf '[[event]]\nwhen = { time = 1 }\ntag = "Mill.E"\nreads = "nothing"\n'; } > $1/town.toml
kbc sim $1/town.kb --scenario $1/town.toml --trace $1/town.jsonl --expect arrived
rules $1/town.jsonl
