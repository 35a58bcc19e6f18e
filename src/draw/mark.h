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
  changed,  ///< both, and they say different things of it
  // Of a state. What is in use runs, is active, or is between what does; what is not is faint.
  active,      ///< in use before the last event and after it
  started,     ///< only after it
  stopped,     ///< only before it
  unavailable  ///< a behavior that could not be activated
};

/// The mark, in a state, of what was in use before the last event, and is after it.
[[nodiscard]] Mark mark_of_use(bool was_in_use, bool is_in_use);

/// The mark of what stands for both: the same; else of a fault, and of a change of any kind. In a
/// state it is in use when one of them is.
[[nodiscard]] Mark combine(Mark a, Mark b);

/// Added and removed as they are, anything else as plain: what does not carry over to what is there
/// through it.
[[nodiscard]] Mark presence_of(Mark mark);

/// The same, but for marks of a state, which are as they are: a behavior in use for one task may be
/// of no use to another one that it could perform.
[[nodiscard]] Mark use_of(Mark mark);

/// The mark of what is there through both. Empty: of two catalogs, none has both. In a state it is
/// in use when both are.
[[nodiscard]] std::optional<Mark> join(Mark a, Mark b);

/// The word for it; empty for what does not stand out.
[[nodiscard]] std::string_view name_of(Mark mark);

}  // namespace cbc::draw
