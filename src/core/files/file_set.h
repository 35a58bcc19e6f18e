#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/catalog/name_place.h"
#include "core/check/check.h"
#include "core/check/severity_settings.h"
#include "core/diagnostic/diagnostic.h"
#include "core/files/read.h"
#include "core/files/recognition.h"
#include "core/property/properties.h"
#include "core/script/script.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/compiled_file.h"
#include "runtime/coordinator/state.h"

namespace cbc::cli {

/// A file that was read.
struct InputFile {
  std::string path;
  std::string name;                         ///< in messages
  std::shared_ptr<const std::string> text;  ///< empty: a compiled catalog to map into memory
  Recognition what;
  std::unique_ptr<const yaml::Document> document;  ///< null: compiled, or no valid YAML
  Diagnostics diagnostics;                         ///< of the YAML

  /// See Recognition::is.
  [[nodiscard]] bool is(FileKind kind) const { return what.is(kind); }
};

/// Who names a file. One that another file names, or to which a link in a folder leads, has to be a
/// regular file, and if it is none for cbc, nothing of it is shown: it may be a file that whoever
/// wrote the other one, or made the link, must not see.
enum class NamedBy : std::uint8_t { command_line, file, link };

/// A catalog that a script or a property file names (catalog: FILE).
struct NamedCatalog {
  std::string path;
  std::string place;  ///< where it is named, "mission.yaml:3:10"
};
/// The catalog that a file names. Empty if it names none.
[[nodiscard]] std::optional<NamedCatalog> catalog_named_by(const InputFile& file);

/// Loads a compiled catalog that was read. If it cannot be used, prints why to standard error.
[[nodiscard]] std::optional<CompiledFile> load_compiled(const InputFile& file);

/// Prints that a file is the log of a stream, and what reads it.
void complain_of_log(const InputFile& file);

/// The texts of files, by their names in messages.
using Texts = std::map<std::string, std::shared_ptr<const std::string>>;

/// Prints findings to standard error: all errors, and the first few warnings of each rule in each
/// file, but no notes. Older names of keys, of which a file usually has many, are only counted.
/// `texts` has the files they are about.
void print_findings(const std::vector<Diagnostic>& findings, const Texts& texts);

/// Finds the settings that apply to a file: those of its `.cbc.yaml`, overridden by those of the
/// command line.
class SettingsFinder {
 public:
  explicit SettingsFinder(SeveritySettings command_line = {});

  /// Empty if the settings file cannot be used; the reason is printed to standard error, once.
  [[nodiscard]] std::optional<SeveritySettings> find(const std::string& path);

 private:
  const SeveritySettings command_line_;
  std::map<std::string, std::optional<SeveritySettings>> known_;  ///< by settings file
};

/// The files of a command line, and those that they name. Reads them, finds their settings, checks
/// them, and collects the findings. What cannot be read is printed to standard error.
class FileSet {
 public:
  enum class Findings : std::uint8_t { kept, dropped };
  /// `settings` are those of the command line; `stdin_name` is the name of standard input.
  explicit FileSet(Findings findings = Findings::kept, SeveritySettings settings = {},
                   std::string stdin_name = display_name("-"))
      : keeps_findings_(findings == Findings::kept),
        stdin_name_(std::move(stdin_name)),
        settings_(std::move(settings)) {}
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;

  /// Reads a file, whatever it is. Null if it cannot be read.
  [[nodiscard]] std::shared_ptr<const InputFile> open(const std::string& path,
                                                      NamedBy named_by = NamedBy::command_line);
  /// The same for a text instead of what is in the file.
  [[nodiscard]] std::shared_ptr<const InputFile> parse(const std::string& path, std::string text);

  enum class Logs : std::uint8_t { refused, accepted };
  /// Reads a file that is to be used. Null if it is not for cbc, or a log that is refused, which is
  /// reported, or if it is not valid YAML, which is a finding.
  [[nodiscard]] std::shared_ptr<const InputFile> read(const std::string& path,
                                                      NamedBy named_by = NamedBy::command_line,
                                                      Logs logs = Logs::refused);
  /// The same for a file that has to be a catalog: a script or a property file is reported.
  [[nodiscard]] std::shared_ptr<const InputFile> read_catalog(
      const std::string& path, NamedBy named_by = NamedBy::command_line);

  /// Empty if the settings of a file cannot be used; the reason is printed.
  [[nodiscard]] std::optional<SeveritySettings> settings_of(const InputFile& file) {
    return settings_.find(file.name);
  }
  [[nodiscard]] std::optional<SeveritySettings> settings_of(const std::string& path) {
    return settings_.find(name_of(path));
  }

  /// What a catalog in YAML is checked for. To use it, other rules than those of reading are
  /// checked if the settings let them fail; for compilation, only those that need a search depend
  /// on that. A drawing shows what can be read, whatever else is wrong: for it, no other rules are
  /// checked, and names that are misspelt in the settings are only reported.
  enum class Purpose : std::uint8_t { use, compilation, drawing };
  /// Reads a catalog in YAML as far as possible, and takes its findings. `is_usable`: there are no
  /// errors; a warning is one if the settings are strict.
  struct Check {
    CheckedCatalog catalog;
    bool is_usable = false;
  };
  [[nodiscard]] Check check(const InputFile& file, Purpose purpose);

  /// Loads a catalog, compiled or YAML. It is not compiled if it has errors, which are findings.
  /// Null if nothing of it can be used; the reason was printed.
  [[nodiscard]] std::shared_ptr<const CheckedCatalog> load(const InputFile& file,
                                                           Purpose purpose = Purpose::use);
  /// The same for a path, which is read only once. Null if it has errors, too.
  [[nodiscard]] std::shared_ptr<const CheckedCatalog> load(
      const std::string& path, NamedBy named_by = NamedBy::command_line);
  /// The same for one that a file names. If there are no findings that say why it cannot be used,
  /// prints where it is named.
  [[nodiscard]] std::shared_ptr<const CheckedCatalog> load(const NamedCatalog& named);

  /// The catalog that a script or a property file names. If it names none, prints that.
  [[nodiscard]] static std::optional<NamedCatalog> expect_catalog(const InputFile& file);

  /// Keeps a catalog that was checked in another way, or null for one that cannot be used.
  void keep(const std::string& path, std::shared_ptr<const CheckedCatalog> catalog) {
    known_.insert_or_assign(key_of(path), Known{std::move(catalog), Fault::known_before});
  }

  /// Who has said why a catalog cannot be used.
  enum class Fault : std::uint8_t { printed, in_findings, known_before };
  /// Of a catalog that was loaded or kept, and cannot be used.
  [[nodiscard]] Fault fault_of(const std::string& path) const {
    return known_.at(key_of(path)).fault;
  }

  /// Reads a script, also one that is a log, or a property file, on a catalog. Empty if there are
  /// errors, which are findings; those of a log are printed. `names`, if not null, takes where
  /// names of the catalog stand, but for a log.
  [[nodiscard]] std::optional<Script> read_script(const InputFile& file,
                                                  const CompiledCatalog& catalog,
                                                  const Snapshot* state = nullptr,
                                                  std::vector<NamePlace>* names = nullptr);
  [[nodiscard]] std::optional<PropertyFile> read_properties(
      const InputFile& file, const CompiledCatalog& catalog,
      std::vector<NamePlace>* names = nullptr);

  /// Prints all findings to standard error, file by file.
  void print_findings();

  /// The findings about all files.
  [[nodiscard]] const std::vector<Diagnostic>& findings() const { return findings_; }

 private:
  struct Known {
    std::shared_ptr<const CheckedCatalog> catalog;
    Fault fault = Fault::printed;
  };

  /// The same for './robot.yaml' and 'robot.yaml'.
  [[nodiscard]] static std::string key_of(const std::string& path);
  [[nodiscard]] const std::string& name_of(const std::string& path) const {
    return path == "-" ? stdin_name_ : path;
  }
  [[nodiscard]] CheckDepth depth_for(Purpose purpose, const SeveritySettings& settings) const;
  [[nodiscard]] bool check_settings(const SeveritySettings& settings, const Catalog& catalog);
  [[nodiscard]] bool take_findings(const InputFile& file, Diagnostics diagnostics,
                                   bool is_complete);
  [[nodiscard]] bool keep_findings(std::vector<Diagnostic> findings,
                                   const SeveritySettings& settings);

  const bool keeps_findings_;
  const std::string stdin_name_;
  SettingsFinder settings_;
  Texts texts_;
  std::vector<Diagnostic> findings_;
  std::size_t faulty_ = 0;  ///< how often a file had errors, even if they were dropped
  std::map<std::string, std::size_t> strict_;  ///< by settings file, how many warnings are errors
  std::map<std::string, Known> known_;         ///< catalogs, by path
};

/// Loads the only catalog of a command line. Null if it cannot be used; the reason is printed.
[[nodiscard]] std::shared_ptr<const CompiledCatalog> load_catalog(const std::string& path);

}  // namespace cbc::cli
