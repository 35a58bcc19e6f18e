#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "catalog/catalog.h"
#include "catalog/reader.h"
#include "compiled/compiled_catalog.h"
#include "compiled/compiled_file.h"
#include "diagnostic/diagnostic.h"
#include "draw/catalog_graph.h"
#include "draw/diagram.h"
#include "lint/controls.h"
#include "yaml/document.h"

/// What a file is, is told by its content.
namespace cbc::cli {

[[nodiscard]] bool is_catalog(const yaml::Document& document);
[[nodiscard]] bool is_script(const yaml::Document& document);

/// The same, or with its events under a misspelt key.
[[nodiscard]] bool looks_like_script(const yaml::Document& document);

/// Whether a text that may be no YAML is meant as a catalog: misspelt keys count, too.
[[nodiscard]] bool looks_like_catalog(std::string_view text);

/// Prints findings to standard error: all errors; of warnings, the first few of each rule and file;
/// no notes. `texts`: the files they are about, by name in messages.
void print_findings(const std::vector<Diagnostic>& findings,
                    const std::map<std::string, std::string>& texts);

/// Texts larger than this are refused (compiled catalogs have a limit of their own), so that no
/// input can eat the memory of the machine.
inline constexpr std::size_t largest_file = std::size_t{256} << 20;

/// Contents of a file, or of standard input for "-". Prints why not to standard error.
[[nodiscard]] std::optional<std::string> read_input(const std::string& path);

/// Name of an input in messages and reports.
[[nodiscard]] std::string display_name(const std::string& path);

/// The files with one of the suffixes (".yaml") of a folder and its folders, sorted by path; hidden
/// ones are passed over, and links to folders. Sets `has_failed`, and prints why to standard error,
/// if a folder cannot be read.
[[nodiscard]] std::vector<std::string> list_folder(const std::string& path,
                                                   std::initializer_list<std::string_view> suffixes,
                                                   bool& has_failed);

[[nodiscard]] bool is_folder(const std::string& path);

/// A file that was read: a text, or a compiled catalog. Its content tells which, not its name.
struct CatalogInput {
  std::string path;
  std::string content;  ///< empty if it is a compiled catalog that can be mapped into memory
  bool is_compiled = false;
};

/// Reads a file, or standard input for "-". Prints why not to standard error.
[[nodiscard]] std::optional<CatalogInput> read_catalog_input(const std::string& path);

/// The compiled catalog that was read. Prints why there is none to standard error.
[[nodiscard]] std::optional<CompiledFile> load(const CatalogInput& input);

/// Finds the settings that hold for a file: those of the command line, over those of its
/// `.cbc.yaml`.
class SettingsFinder {
 public:
  explicit SettingsFinder(SeveritySettings command_line = {});

  /// Empty if there is a settings file that cannot be used; why is printed to standard error, once.
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

/// Reads the files of a command line, and collects what is found in them.
class InputFiles {
 public:
  /// Whether what is found matters: if not, it is dropped, and no settings are looked for.
  enum class Findings : std::uint8_t { kept, dropped };
  explicit InputFiles(Findings findings = Findings::kept)
      : keeps_findings_(findings == Findings::kept) {}
  InputFiles(const InputFiles&) = delete;
  InputFiles& operator=(const InputFiles&) = delete;

  /// Empty if it cannot be read, which is complained of, or is no YAML, which is a finding.
  [[nodiscard]] std::optional<InputFile> read(const std::string& path);

  /// The same of a file that has to be a catalog: a script is complained of.
  [[nodiscard]] std::optional<InputFile> read_catalog(const std::string& path);

  /// The text of a YAML file.
  [[nodiscard]] const std::string& text_of(const yaml::Document& document) const {
    return texts_.at(document.file());
  }

  /// Takes over the findings about a file, but for those that its comments and settings allow.
  /// False if there are errors.
  [[nodiscard]] bool take_findings(const std::string& path, const yaml::Document& document,
                                   Diagnostics diagnostics);

  /// Prints all findings to standard error, file by file.
  void print_findings();

  /// All that was found in all files.
  [[nodiscard]] const std::vector<Diagnostic>& findings() const { return findings_; }

 private:
  const bool keeps_findings_;
  std::map<std::string, std::string> texts_;  ///< by name in messages
  std::vector<Diagnostic> findings_;
  SettingsFinder settings_;
};

/// Loads catalogs, compiled ones or YAML, and keeps them.
class CatalogLoader {
 public:
  /// `files` must outlive this object.
  explicit CatalogLoader(InputFiles& files) : files_(files) {}

  /// Null if it cannot be used: then it has findings that are errors, or was complained of.
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> load(const InputFile& file);
  /// The same for a path, which is read the first time only.
  [[nodiscard]] std::shared_ptr<const CompiledCatalog> load(const std::string& path);

  /// Keeps a catalog that was read in another way; null: it cannot be used.
  void keep(const std::string& path, std::shared_ptr<const CompiledCatalog> catalog) {
    known_.insert_or_assign(path, std::move(catalog));
  }
  /// Whether the path was read.
  [[nodiscard]] bool knows(const std::string& path) const { return known_.contains(path); }

  /// A catalog in YAML, fit to be compiled; empty if there are errors.
  [[nodiscard]] std::optional<Catalog> understand(const std::string& path,
                                                  const yaml::Document& document);

 private:
  InputFiles& files_;
  std::map<std::string, std::shared_ptr<const CompiledCatalog>> known_;  ///< by path
};

/// The one catalog of a command line. Null if it cannot be used, which is said.
[[nodiscard]] std::shared_ptr<const CompiledCatalog> load_catalog(const std::string& path);

/// The path of the catalog that a script at this path names (catalog: FILE). Empty if it names
/// none.
[[nodiscard]] std::optional<std::string> path_of_catalog(const std::string& script_path,
                                                         const yaml::Document& script);

struct InputFile;
class InputFiles;

/// What can be drawn of a catalog, and what it was made of.
struct Drawable {
  std::shared_ptr<const CompiledCatalog> compiled;  ///< of a catalog without errors
  CatalogReading reading;                           ///< of another one
  draw::CatalogGraph graph;
  std::optional<draw::Moment> moment;        ///< of a state
  std::optional<std::string> named_catalog;  ///< path of the catalog that the script names
};

/// Reads a catalog, a compiled one or YAML, which may have errors, and prints what is wrong with
/// it. Null if nothing can be drawn.
[[nodiscard]] std::unique_ptr<Drawable> read_drawable(const std::string& path);

/// The same of a catalog that was read from one of the files; what is wrong with it is left there.
[[nodiscard]] std::unique_ptr<Drawable> to_drawable(InputFiles& files, const InputFile& file);

}  // namespace cbc::cli
