// The readers of the language note where names stand, but they stop where a text is not understood.
// So this is a second account, and a test compares both on all catalogs, scripts and property files
// of the project.

#include "lsp/language/places.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace cbc::lsp {
namespace {

using cli::FileKind;
using Path = std::vector<std::string>;

enum class Role : std::uint8_t { key, value, item };

struct Row {
  FileKind kind;
  Role role;
  /// Of a key the mapping, of a value its key, of an item the list. "-" is an item, "*" any key,
  /// and "a|b" one of two.
  std::string_view path;
  Names names;
};

constexpr Row rows[] = {
    {FileKind::catalog, Role::value, "behaviors/-/behavior", Names::behavior},
    {FileKind::catalog, Role::value, "behaviors|tasks/-/task", Names::task},
    {FileKind::catalog, Role::value, "behaviors/-/tasks|requires/-/task", Names::task},
    {FileKind::catalog, Role::key, "behaviors/-/situation", Names::variable},
    {FileKind::catalog, Role::item, "exclusivity_constraints/-/mutually_exclusive", Names::task},
    {FileKind::catalog, Role::value, "situation/-/variable", Names::variable},
    {FileKind::script, Role::key, "situation", Names::part},
    {FileKind::script, Role::value, "events/-/start|stop", Names::task},
    {FileKind::script, Role::value, "events/-/finish|fault|repair", Names::behavior},
    {FileKind::script, Role::value, "events/-/finish/task", Names::task},
    {FileKind::script, Role::key, "events/-/situation", Names::part},
    {FileKind::script, Role::key, "events/-/expect/running", Names::task},
    {FileKind::script, Role::value, "events/-/expect/running/*", Names::behavior},
    {FileKind::script, Role::item, "events/-/expect/running/*", Names::behavior},
    {FileKind::script, Role::item, "events/-/expect/stopped|suspended", Names::task},
    {FileKind::script, Role::item, "events/-/expect/active|active_includes|failed",
     Names::behavior},
    {FileKind::properties, Role::item, "assume/start|stop", Names::task},
    {FileKind::properties, Role::key, "assume/start", Names::task},
    {FileKind::properties, Role::item, "assume/faults/of|except", Names::behavior},
    {FileKind::properties, Role::item, "assume/situation", Names::part},
    {FileKind::properties, Role::key, "assume/never/-", Names::part},
    {FileKind::properties, Role::item, "assume/together/-", Names::variable},
    {FileKind::properties, Role::key, "initially", Names::part},
    {FileKind::properties, Role::value, "properties/-/can_start|keeps_running", Names::task},
    {FileKind::properties, Role::item, "properties/-/by/-/start|stop", Names::task},
    {FileKind::properties, Role::item, "condition/running|stopped|suspended", Names::task},
    {FileKind::properties, Role::key, "condition/running|requested", Names::task},
    {FileKind::properties, Role::value, "condition/running/*", Names::behavior},
    {FileKind::properties, Role::item, "condition/running/*", Names::behavior},
    {FileKind::properties, Role::item, "condition/active|active_includes|faulty|failed|available",
     Names::behavior},
    {FileKind::properties, Role::key, "condition/situation", Names::part},
    {FileKind::settings, Role::item, "never_together/-", Names::task},
};

/// Takes the part of a text before a separator.
std::string_view take_part(std::string_view& text, char separator) {
  const std::string_view part = text.substr(0, text.find(separator));
  text.remove_prefix(std::min(part.size() + 1, text.size()));
  return part;
}

bool has_step(std::string_view pattern, std::string_view step) {
  while (!pattern.empty()) {
    const std::string_view choice = take_part(pattern, '|');
    if (choice == (step.empty() ? "-" : step) || choice == "*") return true;
  }
  return false;
}

bool matches(std::string_view pattern, const Path& path) {
  return std::all_of(
             path.begin(), path.end(),
             [&](const std::string& step) { return has_step(take_part(pattern, '/'), step); }) &&
         pattern.empty();
}

std::optional<Names> find_names(FileKind kind, Role role, Path path) {
  path = normal_path(std::move(path), kind);
  for (const Row& row : rows) {
    if (row.kind == kind && row.role == role && matches(row.path, path)) return row.names;
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
                                     const Catalog* catalog) {
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
  if (find_variable(catalog, context.text) != nullptr) return NameKind::variable;
  if (find_behavior(catalog, context.text) != nullptr) return NameKind::behavior;
  return std::nullopt;
}

std::vector<Parameter> parameters_at(const Context& context, const Path& path, FileKind kind,
                                     const Catalog* catalog) {
  if (kind != FileKind::script) return {};
  if (normal_path(path, kind) != Path{"events", "", "parameters"}) return {};
  for (const auto& [key, value] : context.outer) {
    const Task* const task = key == "start" ? find_task(catalog, value) : nullptr;
    if (task != nullptr) return task->parameters;
  }
  return {};
}

const Task* find_task(const Catalog* catalog, const std::string& name) {
  return catalog == nullptr ? nullptr : find_in(catalog->tasks, name);
}
const Behavior* find_behavior(const Catalog* catalog, const std::string& name) {
  return catalog == nullptr ? nullptr : find_in(catalog->behaviors, name);
}
const Variable* find_variable(const Catalog* catalog, const std::string& name) {
  return catalog == nullptr ? nullptr : find_in(catalog->variables, name);
}

}  // namespace cbc::lsp
