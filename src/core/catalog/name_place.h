#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/diagnostic/diagnostic.h"

namespace cbc {

/// What a name in a file is the name of.
enum class NameKind : std::uint8_t { task, behavior, variable };

/// "task", "behavior", "variable"
[[nodiscard]] constexpr std::string_view name_of(NameKind kind) {
  constexpr std::string_view names[] = {"task", "behavior", "variable"};
  return names[static_cast<std::size_t>(kind)];
}

/// A place where such a name stands. The readers of catalogs, scripts and property files note them,
/// so that there is no other account of where the language has names.
struct NamePlace {
  NameKind kind = NameKind::task;
  Range range;  ///< of the scalar
};

}  // namespace cbc
