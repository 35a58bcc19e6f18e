#pragma once

#include <string>
#include <vector>

#include "core/property/properties.h"
#include "core/script/script.h"
#include "explore/model/model.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// A path through the states as an event script that `cbc solve` repeats: timeouts are off, the
/// queue comes due where the path says so and nowhere else, and an expectation at the end says in
/// which state the path ends.
struct Witness {
  Script script;
  std::vector<std::string> comments;  ///< by step: lines before it
  std::string text;                   ///< of the script, with comments
  std::vector<Microseconds> due;      ///< when the path lets the queue come due
};

/// The catalog as an exploration of these groups sees it: in others nothing starts by itself. So
/// scripts show only what is of these groups.
[[nodiscard]] CompiledCatalog seen_from(const CompiledCatalog& catalog,
                                        const std::vector<GroupId>& groups);

/// The move as a step of a script. Not for Move::Kind::due, which the clock makes. A change of
/// several variables lists all that may change with them.
[[nodiscard]] Step step_of(const CompiledCatalog& catalog, const Assumptions& assumptions,
                           const Move& move);

/// The script of these moves, made on these groups. `property`: decides what is expected at the
/// end; null: the values of all tasks and, if the last move is a start or a stop, its outcome.
/// `comment`: the first lines of the text, without "# ".
[[nodiscard]] Witness make_witness(const CompiledCatalog& catalog,
                                   const std::vector<GroupId>& groups,
                                   const Assumptions& assumptions, const std::vector<Move>& moves,
                                   const Property* property, const std::string& comment);

/// Moves as a script without expectations, one step for each, timeouts being off: a move of the
/// queue is an empty expectation at the time of the next move, and so is a step more at the end.
/// `pause`: between two moves where nothing is in the queue.
[[nodiscard]] Script make_script(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
                                 const Assumptions& assumptions, const std::vector<Move>& moves,
                                 Microseconds pause);

}  // namespace cbc
