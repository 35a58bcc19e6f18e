# list.bash SCRIPT LINE: prints what the function of SCRIPT offers at the end of LINE, as bash would
# understand it on a command line.
source "$1"

COMP_LINE=$2
COMP_POINT=${#COMP_LINE}
# As bash does it, but for quotes.
placeholder=$'\1'
line=${COMP_LINE//'\ '/$placeholder}
line=${line//=/ = }
read -ra COMP_WORDS <<<"$line"
COMP_WORDS=("${COMP_WORDS[@]//$placeholder/'\ '}")
[[ $COMP_LINE == *' ' ]] && COMP_WORDS+=('')
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))

before=''
[[ $COMP_LINE =~ [^\ ]*=[^\ ]*$ ]] && before=${BASH_REMATCH[0]%"${COMP_WORDS[-1]}"}
program=${COMP_WORDS[0]}
"_$program" "$program" "${COMP_WORDS[-1]}" "${COMP_WORDS[-2]}"
for candidate in "${COMPREPLY[@]}"; do
  eval "candidate=$candidate" # a trap that is not quoted goes off here
  printf '%s\n' "$before$candidate"
done
complete -p "$program" >/dev/null
