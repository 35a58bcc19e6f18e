#include <algorithm>
#include <map>
#include <utility>

#include "core/catalog/renaming.h"
#include "lsp/features/features.h"
#include "lsp/language/context.h"
#include "lsp/language/places.h"
#include "runtime/base/text.h"

namespace cbc::lsp {
namespace {

/// The names in a file, where they stand.
std::vector<NameAt> names_in(const File& file) {
  std::vector<NameAt> names;
  if (file.input == nullptr || file.input->document == nullptr) return names;
  std::map<Position, NameKind> kinds;
  for (const NamePlace& place : file.names) kinds.emplace(place.range.begin, place.kind);
  for (const yaml::Node& node : file.input->document->nodes()) {
    if (node.kind != yaml::Kind::scalar) continue;
    const auto kind = kinds.find(node.range.begin);
    if (kind == kinds.end()) continue;
    names.push_back({kind->second, node.text, file.text->offset_of(node.range.begin),
                     file.text->offset_of(node.range.end)});
  }
  return names;
}

/// What has names of the catalog: itself, what is about it, and its settings.
std::vector<const File*> files_with_names(const Workspace& workspace, const File& catalog) {
  std::vector<const File*> files;
  const std::optional<std::string> settings = workspace.settings_file_of(catalog.path);
  for (const auto& [path, file] : workspace.files()) {
    const bool is_settings = file.kind == cli::FileKind::settings && settings == path;
    if (file.text != nullptr && (is_settings || workspace.catalog_of(file) == &catalog)) {
      files.push_back(&file);
    }
  }
  return files;
}

/// The catalog whose names a file has. Settings may apply to several; then it is the first that has
/// the name.
const File* catalog_with(const Cursor& cursor, const NameAt& name) {
  if (cursor.file.kind != cli::FileKind::settings) return cursor.workspace.catalog_of(cursor.file);
  for (const auto& [path, file] : cursor.workspace.files()) {
    const bool is_catalog = file.kind == cli::FileKind::catalog;
    if (!is_catalog || cursor.workspace.settings_file_of(path) != cursor.file.path) {
      continue;
    }
    for (const NameAt& other : names_in(file)) {
      if (other.kind == name.kind && other.name == name.name) return &file;
    }
  }
  return nullptr;
}

struct Occurrence {
  const File* file = nullptr;
  std::size_t begin = 0;
  std::size_t end = 0;
};

std::vector<Occurrence> occurrences_of(const Workspace& workspace, const File& catalog,
                                       const NameAt& name) {
  std::vector<Occurrence> found;
  for (const File* const file : files_with_names(workspace, catalog)) {
    for (const NameAt& other : names_in(*file)) {
      if (other.kind == name.kind && other.name == name.name) {
        found.push_back({file, other.begin, other.end});
      }
    }
  }
  return found;
}

/// Where a name is defined: a task in its own entry, if it has one.
std::optional<Range> place_of_definition(const File& catalog, const NameAt& name) {
  if (catalog.checked == nullptr || catalog.input->document == nullptr) return std::nullopt;
  const yaml::Node* const tasks = catalog.input->document->root().find("tasks");
  if (name.kind == NameKind::task && tasks != nullptr) {
    for (const yaml::Node* const item : tasks->items) {
      const yaml::Node* const task = item->find("task");
      if (task != nullptr && task->text == name.name) return task->range;
    }
  }
  return place_of_name(catalog.checked->reading.catalog, name.kind, name.name);
}

std::optional<Occurrence> find_defined(const Cursor& cursor, const NameAt& name) {
  const File* const catalog = catalog_with(cursor, name);
  if (catalog == nullptr) return std::nullopt;
  const std::optional<Range> place = place_of_definition(*catalog, name);
  if (!place) return std::nullopt;
  return Occurrence{catalog, catalog->text->offset_of(place->begin),
                    catalog->text->offset_of(place->end)};
}

}  // namespace

std::optional<NameAt> find_name(const Cursor& cursor) {
  const File& file = cursor.file;
  if (file.text == nullptr) return std::nullopt;
  for (NameAt& name : names_in(file)) {
    if (name.begin <= cursor.offset && cursor.offset <= name.end) return std::move(name);
  }
  if (file.input->document != nullptr && !file.names.empty()) return std::nullopt;
  const Context context = context_at(file.text->content(), cursor.offset);
  const std::optional<NameKind> kind =
      name_kind_at(context, file.kind, cursor.workspace.known_catalog(file));
  if (!kind || context.text.empty()) return std::nullopt;
  return NameAt{*kind, context.text, context.begin, context.end};
}

namespace {

/// Where a catalog has a value of a variable; "true" of one without values is the variable itself.
std::optional<Range> place_of_value(const File& catalog, const std::string& variable,
                                    const std::string& value) {
  const auto named = place_of_name(catalog.checked->reading.catalog, NameKind::variable, variable);
  if (!named) return std::nullopt;
  const yaml::Node* const situation = catalog.input->document->root().find("situation");
  if (situation == nullptr) return named;
  for (const yaml::Node* const item : situation->items) {
    const yaml::Node* const name = item->find("variable");
    const yaml::Node* const values = item->find("values");
    if (name == nullptr || name->text != variable || values == nullptr) continue;
    for (const yaml::Node* const one : values->items) {
      if (one->text == value) return one->range;
    }
  }
  return named;
}

/// Of what is no name of the whole catalog: a value of a variable, a parameter of a task.
std::optional<Range> place_of_detail(const Context& context, const File& file,
                                     const File& catalog) {
  if (catalog.checked == nullptr || catalog.input->document == nullptr) return std::nullopt;
  const Catalog& known = catalog.checked->reading.catalog;
  const auto owner = owner_at(context);
  if (owner && find_variable(&known, owner->key) != nullptr) {
    const auto names = names_of_keys(owner->path, file.kind);
    if (names == Names::variable || names == Names::part) {
      return place_of_value(catalog, owner->key, context.text);
    }
  }
  const auto& path = context.is_key ? context.path : owner ? owner->path : context.path;
  const std::string& wanted = context.is_key || !owner ? context.text : owner->key;
  for (const Parameter& parameter : parameters_at(context, path, file.kind, &known)) {
    if (parameter.name == wanted) return parameter.range;
  }
  return std::nullopt;
}

}  // namespace

Json find_definition(const Cursor& cursor) {
  if (cursor.file.text == nullptr) return nullptr;
  const Context context = context_at(cursor.file.text->content(), cursor.offset);
  if (context.path.empty() && context.key == "catalog" && !cursor.file.catalog.empty()) {
    const File* const catalog = cursor.workspace.find(cursor.file.catalog);
    if (catalog != nullptr && catalog->text != nullptr) return location_json(*catalog, 0, 0);
  }
  const std::optional<NameAt> name = find_name(cursor);
  if (!name) {
    const File* const catalog = cursor.workspace.catalog_of(cursor.file);
    const auto place = catalog == nullptr || context.text.empty()
                           ? std::nullopt
                           : place_of_detail(context, cursor.file, *catalog);
    if (!place) return nullptr;
    return location_json(*catalog, catalog->text->offset_of(place->begin),
                         catalog->text->offset_of(place->end));
  }
  const auto found = find_defined(cursor, *name);
  return found ? location_json(*found->file, found->begin, found->end) : Json();
}

Json find_references(const Cursor& cursor, bool with_definition) {
  Json references = Json::array();
  const std::optional<NameAt> name = find_name(cursor);
  const File* const catalog = name ? catalog_with(cursor, *name) : nullptr;
  if (catalog == nullptr) return references;
  const auto defined = find_defined(cursor, *name);
  for (const Occurrence& found : occurrences_of(cursor.workspace, *catalog, *name)) {
    const bool is_definition =
        defined && defined->file == found.file && defined->begin == found.begin;
    if (is_definition && !with_definition) continue;
    references.push_back(location_json(*found.file, found.begin, found.end));
  }
  return references;
}

Json find_highlights(const Cursor& cursor) {
  Json highlights = Json::array();
  const std::optional<NameAt> name = find_name(cursor);
  if (!name) return highlights;
  for (const NameAt& other : names_in(cursor.file)) {
    if (other.kind != name->kind || other.name != name->name) continue;
    highlights.push_back({{"range", range_json(*cursor.file.text, other.begin, other.end)}});
  }
  return highlights;
}

Json prepare_rename(const Cursor& cursor) {
  const std::optional<NameAt> name = find_name(cursor);
  if (!name || catalog_with(cursor, *name) == nullptr) return nullptr;
  return {{"range", range_json(*cursor.file.text, name->begin, name->end)},
          {"placeholder", name->name}};
}

Json rename(const Cursor& cursor, const std::string& new_name, const Client& client) {
  const std::optional<NameAt> name = find_name(cursor);
  const File* const catalog = name ? catalog_with(cursor, *name) : nullptr;
  if (catalog == nullptr) throw Refusal("there is no name of a task, behavior or variable here");
  const Renaming renaming{name->kind, name->name, new_name};
  if (const std::string fault = fault_of_new_name(renaming); !fault.empty()) throw Refusal(fault);
  const auto place = place_of_definition(*catalog, {name->kind, new_name, 0, 0});
  // The situation names behaviors and variables alike.
  const bool is_task = name->kind == NameKind::task;
  const auto alike = is_task ? std::nullopt
                             : place_of_definition(
                                   *catalog, {name->kind == NameKind::behavior ? NameKind::variable
                                                                               : NameKind::behavior,
                                              new_name, 0, 0});
  if (place || alike) throw Refusal(concat("there is a ", quote(new_name), " already"));
  Json changes = Json::array();
  for (const File* const file : files_with_names(cursor.workspace, *catalog)) {
    const std::string& text = file->text->content();
    if (file->input->document == nullptr) {
      if (text.find(name->name) == std::string::npos) continue;
      throw Refusal(concat(file->path, " is not valid YAML, and may have the name"));
    }
    const RenamedText renamed = rename_in(text, *file->input->document, file->names, renaming);
    if (renamed.obstacle) {
      throw Refusal(concat(format_place(file->path, renamed.obstacle->range.begin), ": ",
                           renamed.obstacle->message));
    }
    if (renamed.places == 0) continue;
    Json document = {{"uri", file->uri}, {"version", nullptr}};
    if (file->version) document["version"] = *file->version;
    changes.push_back({{"textDocument", document}, {"edits", edits_json(*file, renamed.text)}});
  }
  return workspace_edit(client, std::move(changes));
}

}  // namespace cbc::lsp
