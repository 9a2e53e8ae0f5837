# What the completion offers where a command line ends, by the alphabet.
source <(kbc completion bash)
compopt() { :; }   # of a shell that nobody types into
ask() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _kbc
  echo "$*: $(printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd' ')"
}
cd "$1" && touch a.kb a.kbt a.csv a.map a.yaml a.fll a.json a.geojson a.xml && mkdir folder
ask kbc check ''
ask kbc budget ''
ask kbc plan ''
for format in fll lif nav2 opentcs; do ask kbc import $format ''; done
ask kbc plan --method ''
ask kbc plan --method bug-
ask kbc test --cov
ask kbc fleet a.kb --scenario a.k
ask kbc experiment --mind a.kb
