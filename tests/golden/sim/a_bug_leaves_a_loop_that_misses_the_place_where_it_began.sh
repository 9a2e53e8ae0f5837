# RUN: bash %s %t
cd ../../../examples/07_open_hall
box() { printf '[[hall.box]]\nfrom = [%s, %s]\nto = [%s, %s]\n' "$@"; }
{ printf 'limit = 1000\n[[hall]]\nroad = "Door.E"\nwidth = 1.8\npillars = "row"\n'
  box 1.59 0.53 2.05 0.90; box 1.02 -0.31 1.64 -0.08; box 1.50 -0.53 1.71 0.17; } > $1/pocket.toml
{ printf 'limit = 1000\n[[hall]]\nroad = "Door.E"\nwidth = 3.3\npillars = "none"\n'
  box 3.51 0.77 3.59 1.50; box 3.81 -1.11 4.33 -0.94; box 4.50 -0.48 5.20 0.11; box 3.14 -0.86 3.59 -0.71; } > $1/corner.toml
kbc sim bug.kb --scenario $1/pocket.toml --expect arrived
kbc sim potential.kb --scenario $1/corner.toml --expect arrived | head -1   # `Escape` is a bug
