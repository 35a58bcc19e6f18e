#pragma once

#include <string>
#include <vector>

/// Names that completion offers.
namespace cbc::cli {

struct CompletionName {
  std::string name;
  std::string help;
};

[[nodiscard]] std::vector<CompletionName> rule_names_with_help();

[[nodiscard]] std::vector<CompletionName> schema_names_with_help();

/// The tasks, on request also the behaviors, of the catalog in a file, or of the one that the
/// script in it names: of a faulty catalog, as far as it is understood. Complaints go to standard
/// error.
[[nodiscard]] std::vector<CompletionName> names_of_file(const std::string& path,
                                                        bool with_behaviors);

}  // namespace cbc::cli
