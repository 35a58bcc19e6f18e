# list.zsh SCRIPT LINE: prints what the function of SCRIPT offers at the end of LINE.
compdef() {}
source $1
# Takes the place of what zsh has in completion only; typing.py has zsh itself do it.
compadd() {
  local name
  for name in ${(P)@[-1]}; do
    if [[ $name == "$PREFIX"* ]]; then print -r -- $name; fi
  done
}

words=(${(z)2})
[[ $2 == *' ' ]] && words+=('')
CURRENT=$#words
PREFIX=$words[-1]
_$words[1]
