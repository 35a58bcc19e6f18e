#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace cbc::draw {

/// How something stands out.
enum class Mark : std::uint8_t {
  plain,
  faint,    ///< it is here for what is next to it
  faulty,   ///< an error of the catalog
  added,    ///< of two catalogs, only the newer one has it
  removed,  ///< only the older one
  changed   ///< both, and they say different things of it
};

/// The mark of what stands for both: the same; else of a fault, and of a change of any kind.
[[nodiscard]] Mark combine(Mark a, Mark b);

/// Added and removed as they are, anything else as plain: what does not carry over to what is there
/// through it.
[[nodiscard]] Mark presence_of(Mark mark);

/// The mark of what is there through both. Empty: of two catalogs, none has both.
[[nodiscard]] std::optional<Mark> join(Mark a, Mark b);

/// The word for it; empty for what does not stand out.
[[nodiscard]] std::string_view name_of(Mark mark);

}  // namespace cbc::draw
