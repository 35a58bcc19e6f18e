#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/output.h"

// The scripts with which a shell asks the program for completions.
namespace cbc::cli {
namespace {

// All of them treat the answers of the program as data: no line is ever evaluated.
// PROGRAM stands for the name of the program.

constexpr std::string_view bash_script =
    R"script(# Completion of PROGRAM for bash, printed by 'PROGRAM completion bash'.
_PROGRAM() {
  local program=${1:-${COMP_WORDS[0]}} line=${COMP_LINE-} part gap last='' suffix i
  local before kept='' typed='' place=0 left=$((${#line} - ${COMP_POINT:-0}))
  local IFS=$' \t\n'
  local -a words=() answer=() suffixes=()
  program=${program/#\~\//$HOME/}
  COMPREPLY=()

  # bash splits words at '=', ':' and '@'. They are put together again.
  line=${line#*"${COMP_WORDS[0]}"}
  for ((i = 1; i < ${#COMP_WORDS[@]}; i++)); do
    part=${COMP_WORDS[i]}
    gap=${line%%[![:space:]]*}
    line=${line#"$gap"}
    if [[ -n $part ]] && ((i == COMP_CWORD && left > ${#line})); then
      words+=('') # bash takes a word that is a blank away
      place=${#words[@]}
    fi
    line=${line#"$part"}
    before=''
    if [[ -z $gap && -n $part && -n $last ]] &&
      [[ -n ${COMP_LINE-} || $part == '=' || $last == '=' ]]; then
      before=${words[-1]}
      words[-1]+=$part
    else
      words+=("$part")
    fi
    last=$part
    if ((i == COMP_CWORD && place == 0)); then
      place=${#words[@]} typed=${words[-1]} kept=$before
      [[ -n $part && -z ${part//[=:@]/} ]] && kept=$typed
      kept=${kept%@} # of these only '@' is replaced
    fi
  done
  ((place)) || return 0
  words[place - 1]=$typed # not with parts behind the cursor

  mapfile -t answer < <(
    "$program" __complete bash "$kept" "$place" "${words[@]}" 2>/dev/null </dev/null
  )
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
      if [[ -z ${answer[1]} ]]; then
        for i in "${!COMPREPLY[@]}"; do # not what would be an option
          [[ ${COMPREPLY[i]} == -* ]] && unset "COMPREPLY[i]"
        done
      fi
      COMPREPLY=("${COMPREPLY[@]#"${answer[2]}"}")
      ;;
  esac
  return 0
}
complete -F _PROGRAM PROGRAM
)script";

constexpr std::string_view zsh_script =
    R"script(#compdef PROGRAM
# Completion of PROGRAM for zsh, printed by 'PROGRAM completion zsh'.
_PROGRAM() {
  local program=${(Q)words[1]} line
  local -a answer names lines ignored
  program=${program/#\~\//$HOME/}
  answer=("${(@f)$("$program" __complete zsh '' $((CURRENT - 1)) "${(@Q)words[2,CURRENT-1]}" \
    "$PREFIX" "${(@Q)words[CURRENT+1,-1]}" 2>/dev/null </dev/null)}")
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
      [[ -z $PREFIX ]] && ignored=(-F '(-*)') # not what would be an option
      if [[ $answer[1] == files ]]; then
        _files $ignored
      else
        _files $ignored -g "*.(${(j:|:)${(s: :)answer[1]#files }})(-.)"
      fi
      ;;
  esac
}
if [[ $funcstack[1] == _PROGRAM ]]; then
  _PROGRAM "$@"
else
  compdef _PROGRAM PROGRAM
fi
)script";

constexpr std::string_view fish_script =
    R"script(# Completion of PROGRAM for fish, printed by 'PROGRAM completion fish'.
function __PROGRAM_complete
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    set -l program (string replace -r '^~/' "$HOME/" -- $words[1])
    # fish does not tell what is behind the cursor.
    set -l answer ($program __complete fish '' (count $words) $words[2..] "$current" \
        2>/dev/null </dev/null)
    switch "$answer[1]"
        case words
            printf '%s\n' $answer[2..]
        case 'files*'
            set -l prefix (string match -r -- '^-[^=]*=' "$current")
            set -l path (string replace -r -- '^-[^=]*=' '' "$current")
            set -l suffixes (string split -n ' ' (string sub -s 6 -- $answer[1]))
            set -l files (complete -C "__fish_command_without_completions $path" |
                string replace -r '\t.*' '')
            if string match -q -r '[:=]' -- "$path" # then fish adds all files behind it
                set -l existing
                for file in $files
                    test -e (string replace -r '^~/' "$HOME/" -- $file); and set -a existing $file
                end
                set files $existing
            end
            # Not what would be an option.
            test -n "$current"; or set files (string match -v -- '-*' $files)
            set -l wanted $files
            if set -q suffixes[1]
                set wanted (string match -r -- '.*(?:/|\.(?:'(string join '|' $suffixes)'))$' $files)
                set -q wanted[1]; or set wanted $files
            end
            set -q wanted[1]; and printf '%s\n' "$prefix"$wanted
    end
end
complete -c PROGRAM -f -a '(__PROGRAM_complete)'
)script";

/// The name whose command lines are completed, for a program that was called as this path or name:
/// its file name, or "cbc" if that has characters that are special to a shell.
std::string name_to_complete(std::string_view called_as) {
  const std::string_view name = called_as.substr(called_as.rfind('/') + 1);
  const bool is_plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c == '+';
  });
  return std::string(is_plain && !name.empty() ? name : "cbc");
}

/// The script for "bash", "zsh" or "fish" that completes the command lines of `program`.
std::string completion_script(std::string_view shell, std::string_view program) {
  constexpr std::string_view placeholder = "PROGRAM";
  std::string script(shell == "bash" ? bash_script : shell == "zsh" ? zsh_script : fish_script);
  for (std::size_t at = 0; (at = script.find(placeholder, at)) != std::string::npos;) {
    script.replace(at, placeholder.size(), program);
    at += program.size();
  }
  return script;
}

constexpr const char* completion_examples =
    "  source <(cbc completion bash)             try it in this bash\n"
    "  cbc completion zsh > ~/.zfunc/_cbc        install it for zsh\n"
    "  cbc completion fish | source              try it in this fish\n";

constexpr const char* completion_footer =
    "To install it for yourself:\n"
    "  bash (with the package bash-completion), one of\n"
    "    mkdir -p ~/.local/share/bash-completion/completions\n"
    "    cbc completion bash > ~/.local/share/bash-completion/completions/cbc\n"
    "    echo 'source <(cbc completion bash)' >> ~/.bashrc    without that package\n"
    "  zsh, with 'fpath+=(~/.zfunc)' before 'compinit' in ~/.zshrc\n"
    "    mkdir -p ~/.zfunc\n"
    "    cbc completion zsh > ~/.zfunc/_cbc\n"
    "  fish\n"
    "    mkdir -p ~/.config/fish/completions\n"
    "    cbc completion fish > ~/.config/fish/completions/cbc.fish\n"
    "\n"
    "The script asks cbc itself what can follow: commands, options and their values, files, "
    "rules, schemas, and the tasks and behaviors of the catalog on the line.\n"
    "\n"
    "Exit status: 0 the script is printed, 2 the usage is wrong.\n"
    "\n"
    "Read more: man cbc";

}  // namespace

void add_completion_command(Program& program) {
  const auto shell = std::make_shared<std::string>();
  Command& command =
      program.add_command("completion", "Prints a script by which a shell completes cbc.",
                          {{"bash|zsh|fish"}, completion_examples, completion_footer});
  command
      .argument("SHELL", *shell, one_of("", {"bash", "zsh", "fish"}),
                "The shell: bash, zsh or fish")
      .required();
  command.action([shell, name = name_to_complete(program.called_as())] {
    fmt::print("{}", completion_script(*shell, name));
    return exit_ok;
  });
}

}  // namespace cbc::cli
