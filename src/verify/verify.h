#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/files/input.h"
#include "core/property/properties.h"
#include "runtime/compiled/compiled_catalog.h"
#include "solve/solve.h"
#include "verify/engine/explore.h"

namespace cbc::cli {

/// The options of `cbc verify`.
struct VerifyOptions {
  std::vector<std::string> paths;
  std::string format = "text";
  std::string output = "-";
  std::optional<std::string> scripts;
  std::optional<std::string> html;
  std::optional<std::string> write_tests;
  std::vector<std::string> beside;  ///< missions that exist: scripts, or folders of them
  bool mutants = false;             ///< judge mutants by these missions, and nothing else
  std::string fail_under;           ///< percent of the mutants; empty: whatever it is
  std::optional<std::uint64_t> jobs;
  bool reduce = false;
  std::optional<std::string> same_as;
  std::uint64_t max_states = 0;
  std::string max_memory;
  std::string time_limit;
  std::vector<std::string> cut_sets;  ///< names of tasks
  std::uint32_t order = 2;
  std::vector<std::string> situation;  ///< KEY=VALUE
};

/// A size of memory, as "512M", in bytes; empty if the text is none.
[[nodiscard]] std::optional<std::uint64_t> parse_memory(const std::string& text);

/// The limits of one exploration.
[[nodiscard]] ExplorationLimits limits_of(const VerifyOptions& options);

/// Makes the folder of --scripts, and looks whether the other outputs can be written. All has been
/// read. Returns the exit status, and prints what is wrong.
[[nodiscard]] int prepare_outputs(const VerifyOptions& options);

/// What a command line asks about, checked before anything is explored.
struct VerifyQuestions {
  std::shared_ptr<const CompiledCatalog> catalog;
  std::optional<std::string> named_catalog;  ///< path of the catalog that the property files name
  std::vector<std::unique_ptr<const PropertyFile>> files;
  std::shared_ptr<const CompiledCatalog> old_catalog;  ///< to compare with, or null
  std::vector<Mission> beside;                         ///< the missions that exist
  /// What the catalog was compiled from; null if it was compiled before.
  std::shared_ptr<const CatalogSource> source;
};

/// What is assumed where goals of coverage count: by the property file, of which there is at most
/// one, or the same as in `cbc solve --prove`.
[[nodiscard]] StatedAssumptions goal_assumptions(const VerifyQuestions& questions);

/// The path by which a script in the folder names the catalog. Empty if that is standard input.
[[nodiscard]] std::string catalog_from(const std::string& folder, const VerifyOptions& options,
                                       const VerifyQuestions& questions);

/// Reads the files of a command line. Findings and other problems go to standard error.
class QuestionLoader {
 public:
  /// `paths`: a catalog, which may be missing if the property files name theirs, then property
  /// files; "-" is standard input. `old_catalog`: to compare with. `beside`: scripts, or folders of
  /// them; those in the folder `left_out` do not count. Empty if anything is wrong.
  [[nodiscard]] std::optional<VerifyQuestions> load(const std::vector<std::string>& paths,
                                                    const std::optional<std::string>& old_catalog,
                                                    const std::vector<std::string>& beside,
                                                    const std::optional<std::string>& left_out);

  /// The findings about the files.
  [[nodiscard]] const std::vector<Diagnostic>& findings() const { return files_.findings(); }

 private:
  void add_first(const std::string& path);
  void add_path(const std::string& path);
  void add_properties(const std::string& path, const yaml::Document& document);
  [[nodiscard]] bool find_catalog(const std::string& path, const yaml::Document& document);
  void refuse(const std::string& path, const char* what);

  InputFiles files_;
  CatalogLoader catalogs_{files_};
  VerifyQuestions questions_;
  bool is_given_ = false;  ///< the catalog, on the command line
  bool has_failed_ = false;
};

/// Writes the scripts that are missing beside the missions that exist, and reports them. Returns
/// the exit status.
[[nodiscard]] int write_tests(const VerifyOptions& options, const VerifyQuestions& questions);

/// Judges mutants of the catalog, and writes the report. Returns the exit status.
[[nodiscard]] int verify_mutants(const VerifyOptions& options, const VerifyQuestions& questions);

/// Answers what the command line asks, and writes the report. Returns the exit status.
[[nodiscard]] int verify(const VerifyOptions& options);

}  // namespace cbc::cli
