#include "cli/completion_scripts.h"

namespace cbc::cli {

// What the program answers is data for all of them: no line of it is ever evaluated.

std::string_view bash_completion() {
  return R"script(# Completion of cbc for bash, printed by 'cbc completion bash'.
_cbc() {
  local program=${1:-${COMP_WORDS[0]}} line=${COMP_LINE-} part='' gap kept='' suffix i
  local IFS=$' \t\n'
  local -a words=() answer=() suffixes=()
  program=${program/#\~\//$HOME/}
  COMPREPLY=()

  # bash splits words at '=' and ':'. They are put together again.
  line=${line#*"${COMP_WORDS[0]}"}
  for ((i = 1; i <= COMP_CWORD; i++)); do
    part=${COMP_WORDS[i]}
    gap=${line%%[![:space:]]*}
    line=${line#"$gap"}
    line=${line#"$part"}
    if [[ $i -gt 1 && -z $gap && -n $part ]] &&
      [[ -n ${COMP_LINE-} || $part == '=' || ${COMP_WORDS[i - 1]} == '=' ]]; then
      kept=${words[-1]}
      words[-1]+=$part
    else
      kept=''
      words+=("$part")
    fi
  done
  ((${#words[@]})) || return 0
  [[ $part == [=:]* ]] && kept=${words[-1]}

  mapfile -t answer < <("$program" __complete bash "$kept" "${words[@]}" 2>/dev/null </dev/null)
  case ${answer[0]-} in
    words) COMPREPLY=("${answer[@]:1}") ;;
    files*)
      compopt -o filenames 2>/dev/null
      read -ra suffixes <<<"${answer[0]#files}"
      if ((${#suffixes[@]})); then
        mapfile -t COMPREPLY < <(
          compgen -d -- "${answer[1]}"
          for suffix in "${suffixes[@]}"; do
            compgen -f -X "!*.$suffix" -- "${answer[1]}"
          done
        )
      fi
      if ((${#COMPREPLY[@]} == 0)); then
        mapfile -t COMPREPLY < <(compgen -f -- "${answer[1]}")
      fi
      COMPREPLY=("${COMPREPLY[@]#"${answer[2]}"}")
      ;;
  esac
  return 0
}
complete -F _cbc cbc
)script";
}

std::string_view zsh_completion() {
  return R"script(#compdef cbc
# Completion of cbc for zsh, printed by 'cbc completion zsh'.
_cbc() {
  local program=${(Q)words[1]} line
  local -a answer names lines
  program=${program/#\~\//$HOME/}
  answer=("${(@f)$("$program" __complete zsh '' "${(@Q)words[2,CURRENT-1]}" "$PREFIX" \
    2>/dev/null </dev/null)}")
  case $answer[1] in
    words)
      for line in "${(@)answer[2,-1]}"; do
        names+=("${line%%$'\t'*}")
        if [[ -n ${line#*$'\t'} ]]; then
          lines+=("${line%%$'\t'*}  -- ${line#*$'\t'}")
        else
          lines+=("${line%%$'\t'*}")
        fi
      done
      compadd -l -d lines -a -- names
      ;;
    files*)
      [[ $PREFIX == -*=* ]] && compset -P 1 '*='
      if [[ $answer[1] == files ]]; then
        _files
      else
        _files -g "*.(${(j:|:)${(s: :)answer[1]#files }})(-.)"
      fi
      ;;
  esac
}
if [[ $funcstack[1] == _cbc ]]; then
  _cbc "$@"
else
  compdef _cbc cbc
fi
)script";
}

std::string_view fish_completion() {
  return R"script(# Completion of cbc for fish, printed by 'cbc completion fish'.
function __cbc_complete
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    set -l program (string replace -r '^~/' "$HOME/" -- $words[1])
    set -l answer ($program __complete fish '' $words[2..] "$current" 2>/dev/null </dev/null)
    switch "$answer[1]"
        case words
            printf '%s\n' $answer[2..]
        case 'files*'
            set -l prefix (string match -r -- '^-[^=]*=' "$current")
            set -l path (string replace -r -- '^-[^=]*=' '' "$current")
            set -l suffixes (string split -n ' ' (string sub -s 6 -- $answer[1]))
            set -l files (complete -C "__fish_command_without_completions $path" |
                string replace -r '\t.*' '')
            set -l wanted $files
            if set -q suffixes[1]
                set wanted (string match -r -- '.*(?:/|\.(?:'(string join '|' $suffixes)'))$' $files)
                set -q wanted[1]; or set wanted $files
            end
            set -q wanted[1]; and printf '%s\n' "$prefix"$wanted
    end
end
complete -c cbc -f -a '(__cbc_complete)'
)script";
}

}  // namespace cbc::cli
