# RUN: bash %s %t
# It is closed in on its way back, and stands `Shut` in the hall. No event is to come.
cd ../../../examples/07_open_hall
box() { printf '[[hall.box]]\nfrom = [%s, %s]\nto = [%s, %s]\n' "$@"; }
{ printf 'limit = 1000\n[[hall]]\nroad = "Door.E"\nwidth = 3.2\npillars = "row"\n'
  box 2.85 1.11 3.13 1.60; box 3.84 0.73 4.40 1.47; box 2.10 -1.60 2.29 -0.89; box 3.32 -1.19 4.00 -0.65; box 3.05 -0.09 3.52 0.60; } > $1/s.toml
kbc sim bug.kb --scenario $1/s.toml --expect arrived
