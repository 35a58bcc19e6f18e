#include "cli/completion_names.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include "cbc/rules.h"
#include "cli/drawable.h"
#include "cli/file_kind.h"
#include "cli/input_files.h"
#include "cli/named_catalog.h"
#include "cli/schemas.h"

namespace cbc::cli {
namespace {

/// What takes longer to read than somebody who presses a key waits.
constexpr std::uintmax_t largest_completed = std::uintmax_t{2} << 20U;
constexpr std::uintmax_t largest_compiled = std::uintmax_t{64} << 20U;

std::string expand_home(const std::string& path) {
  const char* const home = std::getenv("HOME");
  return home != nullptr && path.starts_with("~/") ? home + path.substr(1) : path;
}

/// Nothing else is read: a pipe would never end, nor would a file of the kernel, which has no size.
bool is_readable_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return !error && size > 0 &&
         size <= (path.ends_with(".cbc") ? largest_compiled : largest_completed);
}

std::optional<InputFile> read_if_readable(InputFiles& files, const std::string& path) {
  return is_readable_file(path) ? files.read(path) : std::nullopt;
}

/// The catalog at the path, or the one that the script there names.
std::optional<InputFile> read_catalog_of(InputFiles& files, const std::string& path) {
  std::optional<InputFile> file = read_if_readable(files, path);
  if (!file || file->document == nullptr || !is_script(*file->document)) return file;
  const std::optional<std::string> named = path_of_catalog(path, *file->document);
  return named ? read_if_readable(files, *named) : std::nullopt;
}

}  // namespace

std::vector<CompletionName> rule_names_with_help() {
  std::vector<CompletionName> names;
  for (const Rule& rule : all_rules()) {
    names.push_back({std::string(rule.name), std::string(rule.summary)});
  }
  return names;
}

std::vector<CompletionName> schema_names_with_help() {
  std::vector<CompletionName> names;
  for (const Schema& schema : all_schemas()) {
    names.push_back({std::string(schema.name), title_of(schema)});
  }
  return names;
}

std::vector<CompletionName> names_of_file(const std::string& path, bool with_behaviors) {
  InputFiles files;
  const std::optional<InputFile> catalog = read_catalog_of(files, expand_home(path));
  if (!catalog) return {};
  const std::unique_ptr<Drawable> drawable = to_drawable(files, *catalog);
  if (drawable == nullptr) return {};
  std::vector<CompletionName> names;
  std::set<std::string> known;
  const auto add = [&](const auto& entries, const char* what) {
    for (const auto& entry : entries) {
      std::string name(entry.name);
      if (known.insert(name).second) names.push_back({std::move(name), what});
    }
  };
  add(drawable->graph.tasks, "task");
  if (with_behaviors) add(drawable->graph.behaviors, "behavior");
  return names;
}

}  // namespace cbc::cli
