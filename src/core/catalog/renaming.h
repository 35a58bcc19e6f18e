#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/catalog/name_place.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"

namespace cbc {

/// Calls `visit` with the tasks, behaviors or variables of a catalog, which all have name and
/// range.
template <typename AnyCatalog, typename Visit>
auto visit_named(AnyCatalog& catalog, NameKind kind, const Visit& visit) {
  switch (kind) {
    case NameKind::behavior:
      return visit(catalog.behaviors);
    case NameKind::variable:
      return visit(catalog.variables);
    case NameKind::task:
      break;
  }
  return visit(catalog.tasks);
}

/// Where a name first stands in a catalog; empty if it has none of this kind.
[[nodiscard]] std::optional<Range> place_of_name(const Catalog& catalog, NameKind kind,
                                                 std::string_view name);

/// What gets another name.
struct Renaming {
  NameKind kind = NameKind::task;
  std::string old_name;
  std::string new_name;
};

/// Why nothing can get this name, for people; empty if something can.
[[nodiscard]] std::string fault_of_new_name(const Renaming& renaming);

/// A name as it stands in YAML: in quotes where it needs them.
[[nodiscard]] std::string spell(std::string_view name);

/// A text with the new name in place of the old one.
struct RenamedText {
  std::string text;
  std::size_t places = 0;  ///< where the name was changed

  /// What makes it impossible; then the text is not to be used.
  struct Obstacle {
    Range range;
    std::string message;
  };
  std::optional<Obstacle> obstacle;
};

/// Changes the name where `names` says that it stands, and no other byte. `document` is that of the
/// text.
[[nodiscard]] RenamedText rename_in(std::string_view text, const yaml::Document& document,
                                    const std::vector<NamePlace>& names, const Renaming& renaming);

/// A text as it was read, and where names stand in it.
struct NamedText {
  const yaml::Document& document;
  const std::vector<NamePlace>& names;
};
/// Whether two texts say the same, but for the name. This is found out without what rename_in knows
/// of the text.
[[nodiscard]] bool differ_only_in_name(const NamedText& before, const NamedText& after,
                                       const Renaming& renaming);

/// The same catalog with the new name.
[[nodiscard]] Catalog with_new_name(Catalog catalog, const Renaming& renaming);

}  // namespace cbc
