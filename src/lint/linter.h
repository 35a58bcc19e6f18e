#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/check/check.h"
#include "core/files/file_search.h"
#include "core/files/file_set.h"
#include "lint/report/lint_report.h"

namespace cbc::cli {

/// What the command line of `cbc lint` says.
struct LintCommand {
  std::vector<std::string> paths;
  std::vector<std::string> scripts;
  std::string format = "text";
  SeverityOptions severities;
  std::string stdin_filename;
  std::uint64_t max_nodes = LintOptions{}.max_nodes;
  std::string explain;
  bool list_rules = false;
  bool summary = false;
  bool fix = false;
  bool diff = false;  ///< what --fix would change, instead of changing it
};

/// Lints the files of a command line, with the settings that apply to each. Messages about
/// unreadable files go to standard error.
class Linter {
 public:
  /// `settings` are those of the command line, which override those of files.
  Linter(const LintCommand& command, SeveritySettings settings)
      : command_(command),
        files_(FileSet::Findings::dropped, std::move(settings),
               command.stdin_filename.empty() ? display_name("-") : command.stdin_filename) {}

  /// A catalog; or an event script or a property file that names its catalog; or a settings file.
  void lint_catalog(const std::string& path);
  /// Lints a file that was found in a folder if it is a catalog, or keeps it for lint_found if it
  /// is a script or a property file.
  void lint_in_folder(const std::string& path, const std::string& folder);
  /// Lints the scripts and the property files that were found in folders, with the catalogs that
  /// they name, or else with the only one beside them. Comes after all catalogs.
  void lint_found();
  /// An event script or a property file. `catalog`: path of its catalog; if empty, the one that the
  /// file names.
  void lint_script(const std::string& path, const std::string& catalog);
  /// Checks the settings by what the catalogs are that they apply to. Comes last.
  void check_settings();

  [[nodiscard]] const std::vector<LintedFile>& files() const { return linted_; }
  /// The files of folders that are not valid YAML, and may or may not be meant for cbc.
  [[nodiscard]] const std::vector<std::string>& not_understood() const { return not_understood_; }
  /// Whether a file was linted that was found in a folder of the command line.
  [[nodiscard]] bool has_checked(const std::string& folder) const {
    return checked_folders_.contains(folder);
  }
  /// Whether a file could not be read, or not be written.
  [[nodiscard]] bool has_failed() const { return has_failed_; }
  /// Whether there was an internal error.
  [[nodiscard]] bool has_internal_error() const { return has_internal_error_; }
  /// Whether there is an error, or a warning in a file with strict settings.
  [[nodiscard]] bool has_found() const { return has_found_; }
  [[nodiscard]] const std::string& diff() const { return diff_; }
  /// Whether a file was fixed in place.
  [[nodiscard]] bool has_mended() const { return has_mended_; }

 private:
  using File = std::shared_ptr<const InputFile>;

  /// A script or a property file of a folder.
  struct Found {
    File file;
    std::string folder;  ///< of the command line
  };
  [[nodiscard]] CheckedCatalog check(const InputFile& file, const SeveritySettings& settings) const;
  [[nodiscard]] bool convert(File& file, CheckedCatalog& catalog, const SeveritySettings& settings);
  void fix(File& file, CheckedCatalog& catalog, const SeveritySettings& settings);
  [[nodiscard]] std::shared_ptr<const CheckedCatalog> catalog_of(const InputFile& file,
                                                                 const std::string& given);
  void lint_script(const InputFile& file, const std::string& catalog);
  void lint_catalog(File file);
  void lint_settings(const InputFile& input);
  void take_compiled(const InputFile& file);
  void note_tasks(const Catalog& catalog, const SeveritySettings& settings);
  void add(LintedFile file, const SeveritySettings& settings);
  [[nodiscard]] bool is_to_fix() const { return command_.fix || command_.diff; }

  const LintCommand& command_;
  FileSet files_;
  std::vector<LintedFile> linted_;
  std::vector<std::string> not_understood_;
  /// By settings file, what the names of tasks in it are checked against.
  struct NamedTasks {
    SeveritySettings settings;
    std::set<std::string> tasks;
    bool has_all = true;  ///< all catalogs could be read
  };
  std::map<std::string, NamedTasks> named_tasks_;
  std::vector<Found> found_;
  std::set<std::string> checked_folders_;
  CatalogFolders catalogs_;  ///< those that were linted
  std::string diff_;
  bool has_failed_ = false;
  bool has_internal_error_ = false;
  bool has_found_ = false;
  bool has_mended_ = false;
};

}  // namespace cbc::cli
