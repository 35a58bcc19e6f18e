#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
