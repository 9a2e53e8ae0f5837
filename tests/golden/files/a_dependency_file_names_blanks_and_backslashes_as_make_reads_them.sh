# RUN: bash %s %t
# A tab, a blank and a # are escaped, and backslashes before them; other backslashes are left alone. make and ninja read it.
cd "$1" || exit 1
for folder in 'a\b' 'a b' $'a\tb' 'a\ b' 'a#b' 'a$b'; do
  mkdir "$folder"
  printf 'levels think > act\nfact Wall\nsatellite Halted output\nrule halt at think when Wall then +Halted\n' >"$folder/r.kb"
  kbc compile "$folder/r.kb" -o r --depfile r.d
  head -2 r.d | cat -A
  make -r -s -f r.d r.h && touch r.h && make -r -q -f r.d r.h && echo make finds it
done
