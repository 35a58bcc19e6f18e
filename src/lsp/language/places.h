#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/catalog/name_place.h"
#include "core/files/recognition.h"
#include "lsp/language/context.h"

/// Where names of a catalog stand in text that its readers may not understand yet.
namespace cbc::lsp {

/// What the names at a place are names of. A part of the situation is a behavior or a variable.
enum class Names : std::uint8_t { task, behavior, variable, part };

/// The steps to a place, the same for all places that mean the same: a script that is a list is one
/// with `events`; the path of a condition of a property, wherever it stands, begins with
/// "condition".
[[nodiscard]] std::vector<std::string> normal_path(std::vector<std::string> path,
                                                   cli::FileKind kind);

/// What the scalar at the cursor names, or would name; nothing if it is no name.
[[nodiscard]] std::optional<Names> names_at(const Context& context, cli::FileKind kind);
/// What the keys of the mapping with this path name.
[[nodiscard]] std::optional<Names> names_of_keys(const std::vector<std::string>& path,
                                                 cli::FileKind kind);

/// The mapping and key that a value belongs to, also as an item of a list of values. Empty for a
/// key, and for an item of a list that has no key.
struct Owner {
  std::vector<std::string> path;
  std::string key;
};
[[nodiscard]] std::optional<Owner> owner_at(const Context& context);

/// Whether the scalar (key or value) at this place is the name of a task, behavior or variable. Of
/// a part of the situation the catalog says which; without it, nothing is known.
[[nodiscard]] std::optional<NameKind> name_kind_at(const Context& context, cli::FileKind kind,
                                                   const Catalog* catalog);

/// The parameters of the task of a start whose mapping `parameters` has this path, that of the
/// cursor or of a value in it.
[[nodiscard]] std::vector<Parameter> parameters_at(const Context& context,
                                                   const std::vector<std::string>& path,
                                                   cli::FileKind kind, const Catalog* catalog);

/// The thing of a name; null if there is none.
[[nodiscard]] const Task* find_task(const Catalog* catalog, const std::string& name);
[[nodiscard]] const Behavior* find_behavior(const Catalog* catalog, const std::string& name);
[[nodiscard]] const Variable* find_variable(const Catalog* catalog, const std::string& name);

}  // namespace cbc::lsp
