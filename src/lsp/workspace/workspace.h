#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/catalog/name_place.h"
#include "core/check/check.h"
#include "core/check/severity_settings.h"
#include "core/diagnostic/diagnostic.h"
#include "core/files/file_search.h"
#include "core/files/file_set.h"
#include "lsp/protocol/text.h"

// The files that a client works on: those in the folders of its workspace, and those that it has
// open; as the client has them, or else as they are on the disk. What `cbc lint` says of a folder
// is said of each workspace folder here, file by file, and again after each change only of what the
// change bears on.

namespace cbc::lsp {

/// A file, and what is known of it.
struct File {
  std::string path;
  std::string uri;                      ///< as the client writes it
  std::string folder;                   ///< of the workspace; empty: outside of all
  std::optional<std::int64_t> version;  ///< of the client; empty: not open
  std::shared_ptr<const Text> text;     ///< null: there is no such file
  /// What was parsed; null: never. While somebody types it may be that of an older text: see
  /// check_now.
  std::shared_ptr<const cli::InputFile> input;
  bool is_parsed = false;                     ///< `input` is that of the text
  cli::FileKind kind = cli::FileKind::other;  ///< if the text is broken, what the file was before

  std::string catalog;                               ///< the path of what it is about, or empty
  std::shared_ptr<const CheckedCatalog> checked;     ///< of a catalog
  std::shared_ptr<const CatalogReading> last_names;  ///< of a catalog, when it last had names
  std::vector<NamePlace> names;                      ///< where names of the catalog stand
  std::vector<Diagnostic> findings;
  bool has_all_findings = false;  ///< also those that take a search
  std::uint64_t check = 0;        ///< number of the last check, of all checks of all files

  [[nodiscard]] bool is_about_catalog() const {
    return kind == cli::FileKind::script || kind == cli::FileKind::properties;
  }
  /// Files that are neither open nor in the workspace are others' business.
  [[nodiscard]] bool is_shown() const { return text != nullptr && (version || !folder.empty()); }
};

class Workspace {
 public:
  explicit Workspace(Encoding encoding) : encoding_(encoding) {}

  void add_folder(const std::string& folder);
  void remove_folder(const std::string& folder);

  /// What the client has in place of a file; again after each of its changes.
  void set_text(const std::string& path, const std::string& uri, std::int64_t version,
                std::string text);
  /// From here on the file is what is on the disk.
  void close(const std::string& path);
  /// What is on the disk may have changed.
  void reread(const std::string& path);
  /// Rereads what has changed on the disk of which the client does not tell: what is outside of the
  /// folders or has a name that no client watches; with `at_all`, everything.
  void look_at_disk(bool at_all);

  /// Null: not known. All but the text may be that of an older text: see check_now.
  [[nodiscard]] const File* find(const std::string& path) const;
  [[nodiscard]] const std::map<std::string, File>& files() const { return files_; }
  /// The catalog that a file is, or is about; null if there is none. It may lack findings.
  [[nodiscard]] const File* catalog_of(const File& file) const;
  /// The same as it was when it last had names; null if it never had.
  [[nodiscard]] const Catalog* known_catalog(const File& file) const;

  /// Whether there are files whose findings may be others than before.
  [[nodiscard]] bool has_news() const { return !to_check_.empty() || !checked_.empty(); }
  /// One of them, with its present findings: open ones first, catalogs before what is about them.
  [[nodiscard]] const File& next_checked();
  /// Makes sure that names and findings of a file are those of its present text.
  void check_now(const std::string& path);
  /// The same of all files.
  void check_all();

  /// The next catalog whose findings that take a search are missing; null: none.
  [[nodiscard]] const File* next_to_prove() const;
  /// Adds these, found after `check`. Returns the file, or null if it was checked again since.
  [[nodiscard]] const File* add_proofs(const std::string& path, std::uint64_t check,
                                       CheckedCatalog proved);
  /// The settings file that applies to a file, also one that the client has not saved yet.
  [[nodiscard]] std::optional<std::string> settings_file_of(const std::string& path) const;
  /// The settings that apply to a file; empty if they cannot be used.
  [[nodiscard]] std::optional<SeveritySettings> settings_of(const std::string& path);

 private:
  [[nodiscard]] File& entry(const std::string& path);
  void load(File& file, std::string text);
  void parse(File& file);
  void forget(const std::string& path);
  void mark(const std::string& path);
  void mark_about();
  void mark_all_below(const std::string& folder);
  void note_change(const File& file, cli::FileKind before);
  void check(File& file);
  void check_catalog(File& file);
  void check_about(File& file);
  void note_missing_catalog(File& file) const;
  void check_settings(File& file);
  [[nodiscard]] std::string find_catalog_of(const File& file);
  [[nodiscard]] std::string find_folder(const std::string& path) const;
  [[nodiscard]] std::string next() const;

  const Encoding encoding_;
  cli::FileSet reader_{cli::FileSet::Findings::dropped};
  std::set<std::string> folders_;
  std::map<std::string, File> files_;
  /// Of files that are looked at; empty: there is no such file.
  std::map<std::string, std::optional<std::filesystem::file_time_type>> times_on_disk_;
  std::set<std::string> to_check_;
  std::set<std::string> checked_;           ///< and not yet taken by next_checked
  std::set<std::string> changed_catalogs_;  ///< and files that came, or are no catalogs any more
  bool has_other_catalogs_ = false;         ///< a file became one, or is none any more
  std::map<std::string, cli::CatalogFolders> catalogs_;  ///< by folder of the workspace
  std::uint64_t checks_ = 0;
  std::map<std::string, std::optional<SeveritySettings>> settings_;  ///< by settings file
  std::map<std::string, SeveritySettings> usable_settings_;          ///< the last ones
};

}  // namespace cbc::lsp
