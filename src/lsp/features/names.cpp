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

/// The names in a file, where they stand: as its reader has found them, or else as a text that is
/// not understood looks.
std::vector<NameAt> names_in(const Workspace& workspace, const File& file) {
  std::vector<NameAt> names;
  if (file.text == nullptr) return names;
  if (file.input->document == nullptr || file.names.empty()) {
    const Catalog* const catalog = workspace.known_catalog(file);
    visit_scalars(file.text->content(), [&](const Context& context) {
      const auto kind = name_kind_at(context, file.kind, catalog);
      if (kind) names.push_back({*kind, context.text, context.begin, context.end});
    });
    return names;
  }
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

struct Occurrence {
  const File* file = nullptr;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Where a name stands in one file.
std::vector<Occurrence> occurrences_in(const Workspace& workspace, const File& file,
                                       const NameAt& name) {
  std::vector<Occurrence> found;
  for (const NameAt& other : names_in(workspace, file)) {
    if (other.kind == name.kind && other.name == name.name) {
      found.push_back({&file, other.begin, other.end});
    }
  }
  return found;
}

/// What has names of the catalog: itself, what is about it, and its settings.
std::vector<const File*> files_with_names(const Workspace& workspace, const File& catalog) {
  std::vector<const File*> files;
  const std::optional<std::string> settings = workspace.settings_file_of(catalog.path);
  for (const auto& [path, file] : workspace.files()) {
    const bool is_settings = file.kind == cli::FileKind::settings && settings == path;
    const bool is_meant = file.is_shown() && workspace.catalog_of(file) == &catalog;
    if (file.text != nullptr && (is_settings || is_meant || &file == &catalog)) {
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
    const bool is_catalog = file.kind == cli::FileKind::catalog && file.is_shown();
    if (!is_catalog || cursor.workspace.settings_file_of(path) != cursor.file.path) {
      continue;
    }
    if (!occurrences_in(cursor.workspace, file, name).empty()) return &file;
  }
  return nullptr;
}

/// The entry of a task, behavior or variable in a catalog.
std::optional<Context> find_entry(const File& catalog, NameKind kind, const std::string& name) {
  const bool is_task = kind == NameKind::task;
  const bool is_behavior = kind == NameKind::behavior;
  const std::vector<std::string> path = {is_task       ? "tasks"
                                         : is_behavior ? "behaviors"
                                                       : "situation",
                                         ""};
  const std::string_view key = is_task ? "task" : is_behavior ? "behavior" : "variable";
  std::optional<Context> entry;
  visit_scalars(catalog.text->content(), [&](const Context& context) {
    const bool is_meant = !entry && context.key == key && context.text == name;
    if (is_meant && context.path == path) entry = context;
  });
  return entry;
}

/// Where a name is defined: in its own entry, or else where it stands first, as a task may have no
/// entry.
std::optional<Occurrence> place_of_definition(const Workspace& workspace, const File& catalog,
                                              const NameAt& name) {
  if (catalog.text == nullptr) return std::nullopt;
  if (const auto entry = find_entry(catalog, name.kind, name.name)) {
    return Occurrence{&catalog, entry->begin, entry->end};
  }
  const auto found = occurrences_in(workspace, catalog, name);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

std::optional<Occurrence> find_defined(const Cursor& cursor, const NameAt& name) {
  const File* const catalog = catalog_with(cursor, name);
  if (catalog == nullptr) return std::nullopt;
  return place_of_definition(cursor.workspace, *catalog, name);
}

}  // namespace

std::optional<NameAt> find_name(const Cursor& cursor) {
  for (NameAt& name : names_in(cursor.workspace, cursor.file)) {
    if (name.begin <= cursor.offset && cursor.offset <= name.end) return std::move(name);
  }
  return std::nullopt;
}

namespace {

/// Of what is no name of the whole catalog: a value of a variable, a parameter of a task. "true" of
/// a variable without values is the variable itself.
std::optional<Occurrence> place_of_detail(const Context& context, const File& file,
                                          const File& catalog, const Catalog& known) {
  std::vector<std::string> path = {"tasks", "", "parameters", ""};
  std::string_view key = "parameter";
  std::string wanted = context.text;
  std::optional<Context> entry;
  const auto owner = owner_at(context);
  const auto names = owner ? names_of_keys(owner->path, file.kind) : std::nullopt;
  if (names == Names::variable || names == Names::part) {
    path = {"situation", "", "values"};
    key = "";
    entry = find_entry(catalog, NameKind::variable, owner->key);
  } else {
    const auto& place = context.is_key || !owner ? context.path : owner->path;
    if (!context.is_key && owner) wanted = owner->key;
    if (parameters_at(context, place, file.kind, &known).empty()) return std::nullopt;
    for (const auto& [outer, task] : context.outer) {
      if (outer == "start") entry = find_entry(catalog, NameKind::task, task);
    }
  }
  if (!entry) return std::nullopt;
  std::optional<Occurrence> found;
  visit_scalars(catalog.text->content(), [&](const Context& other) {
    const bool is_meant = !found && other.entry == entry->entry && other.text == wanted;
    if (is_meant && !other.is_key && other.key == key && other.path == path) {
      found = Occurrence{&catalog, other.begin, other.end};
    }
  });
  if (!found && key.empty()) return Occurrence{&catalog, entry->begin, entry->end};
  return found;
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
    const Catalog* const known = cursor.workspace.known_catalog(cursor.file);
    if (known == nullptr || catalog->text == nullptr || context.text.empty()) return nullptr;
    const auto detail = place_of_detail(context, cursor.file, *catalog, *known);
    return detail ? location_json(*detail->file, detail->begin, detail->end) : Json();
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
  for (const File* const file : files_with_names(cursor.workspace, *catalog)) {
    for (const Occurrence& found : occurrences_in(cursor.workspace, *file, *name)) {
      const bool is_definition = defined && defined->file == file && defined->begin == found.begin;
      if (is_definition && !with_definition) continue;
      references.push_back(location_json(*file, found.begin, found.end));
    }
  }
  return references;
}

Json find_highlights(const Cursor& cursor) {
  Json highlights = Json::array();
  const std::optional<NameAt> name = find_name(cursor);
  if (!name) return highlights;
  for (const Occurrence& found : occurrences_in(cursor.workspace, cursor.file, *name)) {
    highlights.push_back({{"range", range_json(*cursor.file.text, found.begin, found.end)}});
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
  const auto has = [&](NameKind kind) {
    return place_of_definition(cursor.workspace, *catalog, {kind, new_name, 0, 0}).has_value();
  };
  // The situation names behaviors and variables alike.
  const bool is_task = name->kind == NameKind::task;
  if (is_task ? has(NameKind::task) : has(NameKind::behavior) || has(NameKind::variable))
    throw Refusal(concat("there is a ", quote(new_name), " already"));
  Json changes = Json::array();
  for (const File* const file : files_with_names(cursor.workspace, *catalog)) {
    const std::string& text = file->text->content();
    if (file->input->document == nullptr) {
      if (text.find(name->name) == std::string::npos) continue;
      throw Refusal(concat(file->path, " is not valid YAML, and may have the name"));
    }
    if (file->names.empty() && !occurrences_in(cursor.workspace, *file, *name).empty()) {
      throw Refusal(
          concat(file->path, " has the name, and is not checked, as the catalog has errors"));
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
