// The readers of the language note where names stand, but they stop where a text is not understood.
// So this is a second account, and a test compares both on all catalogs, scripts and property files
// of the project.

#include "lsp/language/places.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace cbc::lsp {
namespace {

using cli::FileKind;
using Path = std::vector<std::string>;

enum class Role : std::uint8_t { key, value, item };

struct Row {
  Role role;
  /// Of a key the mapping, of a value its key, of an item the list. "-" is an item, "*" any key.
  std::string_view path;
  Names names;
};

constexpr Row names_in_catalogs[] = {
    {Role::value, "behaviors/-/behavior", Names::behavior},
    {Role::value, "behaviors/-/task", Names::task},
    {Role::value, "behaviors/-/tasks/-/task", Names::task},
    {Role::value, "behaviors/-/requires/-/task", Names::task},
    {Role::key, "behaviors/-/situation", Names::variable},
    {Role::value, "tasks/-/task", Names::task},
    {Role::item, "exclusivity_constraints/-/mutually_exclusive", Names::task},
    {Role::value, "situation/-/variable", Names::variable},
};

constexpr Row names_in_scripts[] = {
    {Role::key, "situation", Names::part},
    {Role::value, "events/-/start", Names::task},
    {Role::value, "events/-/stop", Names::task},
    {Role::value, "events/-/finish", Names::behavior},
    {Role::value, "events/-/finish/task", Names::task},
    {Role::key, "events/-/situation", Names::part},
    {Role::value, "events/-/fault", Names::behavior},
    {Role::value, "events/-/repair", Names::behavior},
    {Role::key, "events/-/expect/running", Names::task},
    {Role::value, "events/-/expect/running/*", Names::behavior},
    {Role::item, "events/-/expect/running/*", Names::behavior},
    {Role::item, "events/-/expect/stopped", Names::task},
    {Role::item, "events/-/expect/active", Names::behavior},
    {Role::item, "events/-/expect/active_includes", Names::behavior},
};

constexpr Row names_in_properties[] = {
    {Role::item, "assume/start", Names::task},
    {Role::key, "assume/start", Names::task},
    {Role::item, "assume/stop", Names::task},
    {Role::item, "assume/faults/of", Names::behavior},
    {Role::item, "assume/faults/except", Names::behavior},
    {Role::item, "assume/situation", Names::part},
    {Role::key, "assume/never/-", Names::part},
    {Role::item, "assume/together/-", Names::variable},
    {Role::key, "initially", Names::part},
    {Role::value, "properties/-/can_start", Names::task},
    {Role::value, "properties/-/keeps_running", Names::task},
    {Role::item, "properties/-/by/-/start", Names::task},
    {Role::item, "properties/-/by/-/stop", Names::task},
    {Role::item, "condition/running", Names::task},
    {Role::key, "condition/running", Names::task},
    {Role::value, "condition/running/*", Names::behavior},
    {Role::item, "condition/running/*", Names::behavior},
    {Role::item, "condition/stopped", Names::task},
    {Role::item, "condition/active", Names::behavior},
    {Role::item, "condition/active_includes", Names::behavior},
    {Role::item, "condition/faulty", Names::behavior},
    {Role::item, "condition/available", Names::behavior},
    {Role::key, "condition/requested", Names::task},
    {Role::key, "condition/situation", Names::part},
};

constexpr Row names_in_settings[] = {
    {Role::item, "never_together/-", Names::task},
};

std::span<const Row> rows_of(FileKind kind) {
  switch (kind) {
    case FileKind::catalog:
      return names_in_catalogs;
    case FileKind::script:
      return names_in_scripts;
    case FileKind::properties:
      return names_in_properties;
    case FileKind::settings:
      return names_in_settings;
    case FileKind::compiled:
    case FileKind::log:
    case FileKind::other:
      break;
  }
  return {};
}

bool matches(std::string_view pattern, const Path& path) {
  for (std::size_t place = 0; place < path.size(); ++place) {
    const std::size_t end = std::min(pattern.find('/'), pattern.size());
    const std::string_view step = pattern.substr(0, end);
    if (step != (path[place].empty() ? "-" : path[place]) && step != "*") return false;
    if (end == pattern.size()) return place + 1 == path.size();
    pattern.remove_prefix(end + 1);
  }
  return false;
}

std::optional<Names> find_names(FileKind kind, Role role, Path path) {
  path = normal_path(std::move(path), kind);
  for (const Row& row : rows_of(kind)) {
    if (row.role == role && matches(row.path, path)) return row.names;
  }
  return std::nullopt;
}

template <typename Things>
auto find_in(const Things& things, const std::string& name) -> decltype(things.data()) {
  const auto found = std::find_if(things.begin(), things.end(),
                                  [&name](const auto& thing) { return thing.name == name; });
  return found == things.end() ? nullptr : &*found;
}

}  // namespace

Path normal_path(Path path, FileKind kind) {
  if (kind == FileKind::script && !path.empty() && path.front().empty()) {
    path.insert(path.begin(), "events");
  }
  constexpr std::array<std::string_view, 7> conditions = {
      "always", "never", "reachable", "always_possible", "after", "until", "when"};
  const bool is_condition =
      kind == FileKind::properties && path.size() > 2 && path[0] == "properties" &&
      std::find(conditions.begin(), conditions.end(), path[2]) != conditions.end();
  if (!is_condition) return path;
  std::size_t inner = 3;
  while (inner < path.size()) {
    const bool is_list = path[inner] == "any" || path[inner] == "all";
    if (path[inner] != "not" && !(is_list && inner + 1 < path.size())) break;
    inner += is_list ? 2 : 1;
  }
  path.erase(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(inner));
  path.insert(path.begin(), "condition");
  return path;
}

std::optional<Names> names_at(const Context& context, FileKind kind) {
  if (context.is_key) return names_of_keys(context.path, kind);
  if (context.is_item) return find_names(kind, Role::item, context.path);
  if (context.key.empty()) return std::nullopt;
  Path path = context.path;
  path.push_back(context.key);
  return find_names(kind, Role::value, std::move(path));
}

std::optional<Names> names_of_keys(const Path& path, FileKind kind) {
  return find_names(kind, Role::key, path);
}

std::optional<Owner> owner_at(const Context& context) {
  if (!context.key.empty()) return Owner{context.path, context.key};
  if (!context.is_item || context.path.empty() || context.path.back().empty()) return std::nullopt;
  return Owner{{context.path.begin(), context.path.end() - 1}, context.path.back()};
}

std::optional<NameKind> name_kind_at(const Context& context, FileKind kind,
                                     const Catalog* of_names) {
  const auto names = names_at(context, kind);
  if (!names || context.text.empty()) return std::nullopt;
  switch (*names) {
    case Names::task:
      return NameKind::task;
    case Names::behavior:
      // The word stands for all behaviors of a running task.
      if (context.text == "any" && !context.path.empty() && context.path.back() == "running") {
        return std::nullopt;
      }
      return NameKind::behavior;
    case Names::variable:
      return NameKind::variable;
    case Names::part:
      break;
  }
  if (find_variable(of_names, context.text) != nullptr) return NameKind::variable;
  if (find_behavior(of_names, context.text) != nullptr) return NameKind::behavior;
  return std::nullopt;
}

const Task* find_task(const Catalog* of_names, const std::string& name) {
  return of_names == nullptr ? nullptr : find_in(of_names->tasks, name);
}
const Behavior* find_behavior(const Catalog* of_names, const std::string& name) {
  return of_names == nullptr ? nullptr : find_in(of_names->behaviors, name);
}
const Variable* find_variable(const Catalog* of_names, const std::string& name) {
  return of_names == nullptr ? nullptr : find_in(of_names->variables, name);
}

}  // namespace cbc::lsp
