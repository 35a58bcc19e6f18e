#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/catalog/reader.h"
#include "core/check/controls.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/compiled_file.h"

/// Reads the files that command lines name. Their content tells what they are, not their names.
namespace cbc::cli {

[[nodiscard]] bool is_catalog(const yaml::Document& document);
[[nodiscard]] bool is_script(const yaml::Document& document);
/// Whether it is a property file: it has the key `properties` or `assume`.
[[nodiscard]] bool is_property_file(const yaml::Document& document);

/// Whether it is a script, or would be one but for a misspelt key.
[[nodiscard]] bool looks_like_script(const yaml::Document& document);

/// Prints that a file is the log of a stream, and what reads it.
void complain_of_log(const std::string& name);

/// What a file is that was found in a folder.
enum class FoundFile : std::uint8_t {
  catalog,
  script,                  ///< or a property file
  script_without_catalog,  ///< the same, but it is valid and names no catalog
  other
};

/// What a text, even one that is not valid YAML, is meant as. A catalog may have misspelt keys; a
/// script names a catalog or has an event with a known verb, as folders have all kinds of YAML
/// files.
[[nodiscard]] FoundFile recognize(std::string_view text);

/// The content of a file, or of standard input for "-". If it cannot be read, prints why to
/// standard error.
[[nodiscard]] std::optional<std::string> read_input(const std::string& path);

/// The same for a JSON result that is to be merged with others.
[[nodiscard]] std::optional<std::string> read_result(const std::string& path);

/// The name of an input in messages and reports.
[[nodiscard]] std::string display_name(const std::string& path);

/// The files in a folder and its subfolders that have one of the suffixes (".yaml"), sorted by
/// path. Hidden files and links to folders are skipped. If a folder cannot be read, sets
/// `has_failed` and prints why to standard error.
[[nodiscard]] std::vector<std::string> list_folder(const std::string& path,
                                                   std::initializer_list<std::string_view> suffixes,
                                                   bool& has_failed);

[[nodiscard]] bool is_folder(const std::string& path);

/// A file that was read: a text, or a compiled catalog.
struct CatalogInput {
  std::string path;
  std::string content;  ///< empty if it is a compiled catalog that can be mapped into memory
  bool is_compiled = false;
};

/// Reads a file, or standard input for "-". If it cannot be read, prints why to standard error.
[[nodiscard]] std::optional<CatalogInput> read_catalog_input(const std::string& path);

/// Loads a compiled catalog that was read. If it cannot be used, prints why to standard error.
[[nodiscard]] std::optional<CompiledFile> load(const CatalogInput& input);

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

/// A file of a command line: YAML, or a compiled catalog.
struct InputFile {
  std::string path;
  std::unique_ptr<const yaml::Document> document;  ///< null: a compiled catalog
  CatalogInput compiled;
};

/// Who names a file. One that another file names, or to which a link in a folder leads, has to be a
/// regular file, and if it is none for cbc, nothing of it is shown: it may be a file that whoever
/// wrote the other one, or made the link, must not see.
enum class NamedBy : std::uint8_t { command_line, file, link };

/// Reads the files of a command line, and collects the findings about them.
class InputFiles {
 public:
  enum class Findings : std::uint8_t { kept, dropped };
  /// `settings` are those of the command line.
  explicit InputFiles(Findings findings = Findings::kept, SeveritySettings settings = {})
      : keeps_findings_(findings == Findings::kept), settings_(std::move(settings)) {}
  InputFiles(const InputFiles&) = delete;
  InputFiles& operator=(const InputFiles&) = delete;

  /// Empty if the file cannot be read, which is reported, or is not valid YAML, which is a finding.
  [[nodiscard]] std::optional<InputFile> read(const std::string& path,
                                              NamedBy named_by = NamedBy::command_line);

  /// The same for a file that has to be a catalog: a script or a property file is reported.
  [[nodiscard]] std::optional<InputFile> read_catalog(const std::string& path,
                                                      NamedBy named_by = NamedBy::command_line);

  /// The text of a YAML file.
  [[nodiscard]] const std::string& text_of(const yaml::Document& document) const {
    return texts_.at(document.file());
  }

  /// Adds the findings about a file, except those that its comments and settings allow. False if
  /// there are errors; a warning is one if the settings are strict. `is_complete`: there are all
  /// findings that lint would have.
  [[nodiscard]] bool take_findings(const std::string& path, const yaml::Document& document,
                                   Diagnostics diagnostics, bool is_complete);

  struct CheckedFile {
    CatalogReading reading;
    bool is_usable = false;  ///< there are no errors
  };
  /// Reads a catalog as far as possible, and adds the findings in the same way. Other rules than
  /// those of reading are checked if the settings let them fail; for compilation, only those that
  /// need a search depend on that. A drawing shows what can be read, whatever else is wrong: for
  /// it, no other rules are checked, and names that are misspelt in the settings are only reported.
  enum class Purpose : std::uint8_t { use, compilation, drawing };
  [[nodiscard]] CheckedFile check_catalog(const std::string& path, const yaml::Document& document,
                                          Purpose purpose);

  /// Prints all findings to standard error, file by file.
  void print_findings();

  /// The findings about all files.
  [[nodiscard]] const std::vector<Diagnostic>& findings() const { return findings_; }

  /// How often there were errors among the findings about a file, even if they were dropped.
  [[nodiscard]] std::size_t faulty() const { return faulty_; }

 private:
  [[nodiscard]] CheckedFile check_by_rules(const std::string& path, const yaml::Document& document,
                                           Purpose purpose, const SeveritySettings& settings);
  [[nodiscard]] bool check_settings(const SeveritySettings& settings, const Catalog& catalog);
  [[nodiscard]] bool keep(std::vector<Diagnostic> findings, const SeveritySettings& settings);

  const bool keeps_findings_;
  std::map<std::string, std::string> texts_;  ///< by name in messages
  std::vector<Diagnostic> findings_;
  std::size_t faulty_ = 0;
  /// By settings file, how many warnings it makes errors.
  std::map<std::string, std::size_t> strict_;
  SettingsFinder settings_;
};

/// A catalog that a script or a property file names (catalog: FILE).
struct NamedCatalog {
  std::string path;
  std::string place;  ///< where it is named, "mission.yaml:3:10"
};
/// The catalog that the file at this path names. Empty if it names none.
[[nodiscard]] std::optional<NamedCatalog> catalog_named_by(const std::string& path,
                                                           const yaml::Document& document);

/// What was compiled.
struct CatalogSource {
  Catalog catalog;
  std::string text;
};

/// Loads catalogs, compiled ones or YAML, and keeps them.
class CatalogLoader {
 public:
  /// `files` must outlive this object.
  explicit CatalogLoader(InputFiles& files) : files_(files) {}

  /// From now on, also keeps what it compiles.
  void keep_sources() { keeps_sources_ = true; }
  /// Null if the catalog was compiled before.
  [[nodiscard]] std::shared_ptr<const CatalogSource> source_of(
      const CompiledCatalog& catalog) const {
    const auto found = sources_.find(&catalog);
    return found == sources_.end() ? nullptr : found->second;
  }

  /// Null if the catalog cannot be used: the findings have its errors, or the reason was printed.
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> load(const InputFile& file);
  /// The same for a path, which is read only once.
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> load(
      const std::string& path, NamedBy named_by = NamedBy::command_line);

  /// The same for one that a file names. If it cannot be used, and there are no findings that say
  /// why, prints where it is named.
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> load(const NamedCatalog& named);

  /// Keeps a catalog that was read in another way, or null for one that cannot be used.
  void keep(const std::string& path, std::shared_ptr<const CompiledCatalog> catalog) {
    known_.insert_or_assign(key_of(path), Known{std::move(catalog), Fault::known_before});
  }

  /// Who has said why a catalog cannot be used.
  enum class Fault : std::uint8_t { printed, in_findings, known_before };
  /// Of a catalog that was loaded or kept, and cannot be used.
  [[nodiscard]] Fault fault_of(const std::string& path) const {
    return known_.at(key_of(path)).fault;
  }

  /// A catalog in YAML, fit to be compiled; empty if there are errors.
  [[nodiscard]] std::optional<Catalog> understand(
      const std::string& path, const yaml::Document& document,
      InputFiles::Purpose purpose = InputFiles::Purpose::compilation);

 private:
  struct Known {
    std::shared_ptr<const CompiledCatalog> catalog;
    Fault fault = Fault::printed;
  };

  /// The same for './robot.yaml' and 'robot.yaml'.
  [[nodiscard]] static std::string key_of(const std::string& path);

  InputFiles& files_;
  bool keeps_sources_ = false;
  std::map<std::string, Known> known_;
  std::map<const CompiledCatalog*, std::shared_ptr<const CatalogSource>> sources_;
};

/// Loads the only catalog of a command line. Null if it cannot be used; the reason is printed.
[[nodiscard]] std::shared_ptr<const CompiledCatalog> load_catalog(const std::string& path);

/// Reads a file, a pipe or a terminal line by line, as soon as a line is complete.
class LineInput {
 public:
  enum class Status : std::uint8_t {
    line,      ///< see line() and number()
    waiting,   ///< nothing has come in the given time
    too_long,  ///< a line was skipped because it is too long; see number()
    end,
    stopped,  ///< a signal has come
    failed    ///< see error()
  };

  /// `descriptor` is not closed. `stop`: a descriptor that becomes readable when it is time to
  /// stop, or -1. `before_reading` is called when all complete lines were handed out, before the
  /// next ones are read or waited for.
  LineInput(int descriptor, int stop, std::size_t longest_line,
            std::function<void()> before_reading)
      : descriptor_(descriptor),
        stop_(stop),
        longest_line_(longest_line),
        before_reading_(std::move(before_reading)) {}

  /// Waits for the next line, at most `longest_wait` milliseconds if that is not negative.
  [[nodiscard]] Status next(int longest_wait = -1);
  /// Without its end; valid until the next call.
  [[nodiscard]] std::string_view line() const { return line_; }
  /// Counts lines from 1.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  [[nodiscard]] Status fill(int longest_wait);

  int descriptor_;
  int stop_;
  std::size_t longest_line_;
  std::function<void()> before_reading_;
  std::string buffer_;
  std::size_t begin_ = 0;    ///< of the next line
  std::size_t scanned_ = 0;  ///< there is no line end before this
  bool has_ended_ = false;
  bool skips_ = false;  ///< in a line that is too long
  std::string_view line_;
  std::uint64_t number_ = 0;
  std::string error_;
};

}  // namespace cbc::cli
