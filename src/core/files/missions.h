#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/files/file_set.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::cli {

/// A script and the catalog it runs on.
struct Mission {
  std::shared_ptr<const CompiledCatalog> catalog;
  Script script;
  std::shared_ptr<const CheckedCatalog> source;  ///< of `catalog`
  std::string outdated;  ///< why it cannot run, see MissionLoader::keep_outdated(); or empty
};

/// Reads the files of a command line, and checks every script against its catalog before anything
/// runs. Findings and other problems go to standard error.
class MissionLoader {
 public:
  /// From now on, folders and paths may be without a script.
  void need_none() { needs_none_ = true; }
  /// Beside others, a script that names what its catalog does not have, and is right otherwise, is
  /// a mission without steps.
  void keep_outdated() { keeps_outdated_ = true; }
  /// All scripts run on this catalog, and the paths are those of scripts alone.
  void give_catalog(std::shared_ptr<const CheckedCatalog> catalog) {
    given_catalog_ = std::move(catalog);
  }
  /// Scripts in this folder do not count.
  void leave_out(std::string folder) { left_out_ = std::move(folder); }

  /// `paths`: a catalog (which may be missing if the scripts name theirs), then scripts; "-" is a
  /// script from standard input, a folder stands for the scripts in it. Empty if anything is wrong.
  [[nodiscard]] std::optional<std::vector<Mission>> load(const std::vector<std::string>& paths);

  /// The catalog among the paths, or null.
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> given_catalog() const {
    return given_catalog_ == nullptr ? nullptr : given_catalog_->compiled;
  }
  /// The findings about the files.
  [[nodiscard]] const std::vector<Diagnostic>& findings() const { return files_.findings(); }

 private:
  [[nodiscard]] std::shared_ptr<const CheckedCatalog> catalog_of(const InputFile& script);
  void add_script(const InputFile& file);
  void add_folder(const std::string& path);
  void add_path(const std::string& path);
  [[nodiscard]] bool is_left_out(const std::string& path) const;
  void refuse(const InputFile& file, const char* what);
  [[nodiscard]] std::string find_outdated(std::size_t first_finding) const;

  FileSet files_;
  std::shared_ptr<const CheckedCatalog> given_catalog_;
  bool is_given_catalog_bad_ = false;
  std::vector<Mission> missions_;
  bool needs_none_ = false;
  bool keeps_outdated_ = false;
  std::size_t outdated_ = 0;
  std::optional<std::string> left_out_;
  bool has_failed_ = false;
};

/// The path by which a script in the folder names a catalog. Empty if that is standard input.
[[nodiscard]] std::string path_in_script(const std::string& catalog, const std::string& folder);

/// Prints why the run of a mission ended early.
void complain_of_run(const Mission& mission, const RunResult& result, const std::string& reason);

}  // namespace cbc::cli
