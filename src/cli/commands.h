#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"

/// The commands of the program, for main.
namespace cbc::cli {

void add_lint_command(Program& program);
void add_compile_command(Program& program);
void add_solve_command(Program& program);
void add_graph_command(Program& program);
void add_schema_command(Program& program);
/// The program was called as the path or name `called_as`: its scripts complete that name.
void add_completion_command(Program& program, std::string_view called_as);

/// The first argument by which the scripts of `cbc completion` call the program.
inline constexpr const char* complete_argument = "__complete";

/// Answers such a call, with what can stand where a word is being typed.
///
/// Arguments: the shell; of the word that is being typed what the shell does not replace (bash
/// replaces what follows '=' or ':', or begins with '@'); the number of that word; all words after
/// the name of the program. With the quotes of the shell are: the word that is being typed, for
/// bash all of them.
///
/// The first line of the answer is "words", and a candidate follows on each line, with a tab before
/// its help: for bash, which has no help, quoted as it has to be inserted. Or it is "files", with
/// the wanted suffixes: two lines follow, with the beginning of the path, and how much of that the
/// shell does not replace. Names that do not fit on a line, or could harm a terminal, are left out.
void reply_to_shell(const Program& program, const std::vector<std::string>& arguments);

}  // namespace cbc::cli
