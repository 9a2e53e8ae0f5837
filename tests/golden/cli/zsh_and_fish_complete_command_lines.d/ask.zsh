# ask.zsh FOLDER < LINES: what zsh offers at the end of each line, by the alphabet. An interactive zsh is asked through a pseudo-terminal;
# its completion prints what it offers.
zmodload zsh/zpty
cd $1
zpty asked zsh -f -i
say() { zpty -w asked "$1" }
say 'PS1= PS2= RPS1= ; unset zle_bracketed_paste; unsetopt prompt_cr prompt_sp'
say 'autoload -U compinit && compinit -u -D'
say 'source <(kbc completion zsh)'
# With -O, -A or -D it is only asked what would match.
say 'compadd() {
  if [[ ${@[(I)-[OAD]]} -gt 0 ]]; then builtin compadd "$@"; return; fi
  local -a hits
  builtin compadd -A hits "$@"
  (( $#hits )) || return 1
  print -l -- "offered "${^hits}
  builtin compadd "$@"
}'
say 'show() { print; _main_complete; print end; compstate[insert]=; compstate[list]= }; zle -C show complete-word show; bindkey "^I" show'
while IFS= read -r line; do
  zpty -w -n asked "$line"$'\t'
  zpty -r asked answer $'*end\r\n*'
  offered=(${(M)${(f)answer//$'\r'}:#offered *})
  print -r -- "$line:" ${(ou)offered#offered }
  zpty -w -n asked $'\x15'   # Ctrl-U
done
zpty -d asked
