#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/solve.h"

namespace cbc::cli {

/// What the program exits with (the same for every command).
enum ExitStatus : int {
  exit_ok = 0,
  exit_no = 1,        ///< the answer is "no": an expectation failed, a file is stale
  exit_unusable = 2,  ///< usage, unreadable or invalid input, output that could not be written
  exit_internal = 3   ///< an answer that the checker refuses
};

/// All commands of the program, in the order of --help.
[[nodiscard]] std::vector<CLI::App*> commands_of(CLI::App& program);

/// Null if there is none of this name.
[[nodiscard]] CLI::App* find_command(CLI::App& program, const std::string& name);

}  // namespace cbc::cli

namespace CLI {
class App;
}

namespace cbc::cli {

/// Adds `cbc compile` to the program. Where it is called, `status` receives the exit status.
void add_compile_command(CLI::App& program, int& status);

}  // namespace cbc::cli

namespace CLI {
class App;
}

namespace cbc::cli {

/// Adds `cbc completion` to the program, which was called as the path or name `called_as`: its
/// scripts complete that name. Where the command is called, `status` receives the exit status.
void add_completion_command(CLI::App& program, std::string_view called_as, int& status);

}  // namespace cbc::cli

namespace CLI {
class App;
}

namespace cbc::cli {

/// Adds `graph` to the program. When it is parsed, it runs and sets `status`.
void add_graph_command(CLI::App& program, int& status);

}  // namespace cbc::cli

namespace CLI {
class App;
}

namespace cbc::cli {

/// Adds `cbc lint` to the program. Where it is called, `status` receives the exit status.
void add_lint_command(CLI::App& program, int& status);

}  // namespace cbc::cli

namespace CLI {
class App;
}

namespace cbc::cli {

/// Adds `schema` to the program. When it is parsed, it runs and sets `status`.
void add_schema_command(CLI::App& program, int& status);

}  // namespace cbc::cli

namespace CLI {
class App;
}

namespace cbc::cli {

/// Adds `cbc solve` to the program. Where it is called, `status` receives the exit status.
void add_solve_command(CLI::App& program, int& status);

/// Runs a sweep on the catalog of the path, or merges the shards there. Returns the exit status.
[[nodiscard]] int run_sweep(const SolveOptions& options);

/// The JSON Schemas of the folder schemas/, which are part of the program.

struct Schema {
  std::string_view name;  ///< of its file, without the suffix
  std::string_view text;
};

/// In the order of their names.
[[nodiscard]] std::span<const Schema> all_schemas();

/// In one line, what the schema describes.
[[nodiscard]] std::string title_of(const Schema& schema);

/// The text of a schema that needs no other file: those that it refers to are part of it.
[[nodiscard]] std::string standalone(const Schema& schema);

}  // namespace cbc::cli

namespace CLI {
class App;
}

namespace cbc::cli {

/// What can stand where a word of a command line is being typed.
struct Completion {
  struct Candidate {
    std::string text;  ///< without `prefix`
    std::string help;  ///< on one line; may be empty
  };
  std::vector<Candidate> candidates;
  bool is_file = false;                    ///< the shell offers files
  std::vector<std::string_view> suffixes;  ///< of the files, without dots; empty: all files
  std::string prefix;                      ///< of the last word, before the value: "--format="
};

/// Derived from the definition of the command line. `words`: those after the name of the program;
/// the last one, which may be empty, is being typed. `behind`: the words behind that one. Where
/// names out of a catalog can follow, the catalog is read.
[[nodiscard]] Completion complete(CLI::App& program, const std::vector<std::string>& words,
                                  const std::vector<std::string>& behind);

}  // namespace cbc::cli

namespace CLI {
class App;
}

namespace cbc::cli {

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
void reply_to_shell(CLI::App& program, const std::vector<std::string>& arguments);

}  // namespace cbc::cli
