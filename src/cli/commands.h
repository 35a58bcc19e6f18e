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
/// `called_as`: the path or name under which the program was called, which its scripts complete.
void add_completion_command(Program& program, std::string_view called_as);

/// The first argument by which the scripts of `cbc completion` call the program.
inline constexpr const char* complete_argument = "__complete";

/// Answers such a call with the words that fit where a word is being typed.
///
/// The arguments are the shell; the part of the typed word that the shell does not replace (bash
/// replaces what follows '=' or ':', or begins with '@'); the number of the typed word; and all
/// words after the name of the program. The typed word has the quotes of the shell; for bash all
/// words do.
///
/// The first line of the answer is "words" or "files". After "words" each line has a candidate,
/// with a tab before its help; for bash, which shows no help, the candidate is quoted for
/// insertion. "files" is followed on its line by the accepted suffixes; two more lines have the
/// beginning of the path, and the part of it that the shell does not replace. Names with line
/// breaks or with characters that could harm a terminal are left out.
void reply_to_shell(const Program& program, const std::vector<std::string>& arguments);

}  // namespace cbc::cli
