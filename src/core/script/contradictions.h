#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "ask/conflict/reasons.h"
#include "ask/formula.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/condition.h"
#include "runtime/compiled/compiled_catalog.h"

// Which parts of conditions no state satisfies together, decided by search.

namespace cbc {

/// Something that can never hold.
struct Impossible {
  Range range;
  std::string why;
  std::vector<Note> notes = {};
  std::string because = {};     ///< the constraints of the catalog that it takes
  std::size_t constraints = 0;  ///< how many

  [[nodiscard]] std::string text() const { return because.empty() ? why : why + ", as " + because; }
};

/// Of what is looked at, which constraints count.
enum class Ground : std::uint8_t {
  words,       ///< that a task has one behavior at most, and an active behavior performs a task
  exclusions,  ///< also those of exclusivity
  catalog      ///< all
};

/// Finds what contradicts in conditions that all hold.
class Contradictions {
 public:
  /// A condition that is no `all`, and its formula.
  struct Part {
    const StateCondition* condition;
    std::shared_ptr<const Formula> formula;
  };
  using Parts = std::vector<Part>;

  /// The catalog must outlive this object.
  explicit Contradictions(const CompiledCatalog& catalog) : catalog_(catalog), formulas_(catalog) {}

  /// Appends the parts of a condition, which must outlive them. Left out are the conditions of
  /// `any`, of which not all hold.
  void add(const StateCondition& condition, Parts& parts) const;

  /// Behaviors that do not perform the task that they are listed for; by words alone only those of
  /// lists in which none does. Parts with such lists are taken out.
  [[nodiscard]] std::vector<Impossible> take_misplaced(Parts& parts, Ground ground) const;

  /// Minimal sets of parts that no state of `states` satisfies, each reported at the last of its
  /// parts; not all, and the last not minimal, if the effort ends. What is left holds together.
  [[nodiscard]] std::vector<Impossible> find(Parts& parts, Ground ground, StateAsk& states,
                                             const Reporter& reporter) const;

 private:
  [[nodiscard]] std::vector<const Part*> minimal(std::span<const Part* const> parts, Ground ground,
                                                 StateAsk& states) const;
  [[nodiscard]] Impossible describe(std::span<const Part* const> parts, Ground ground,
                                    StateAsk& states, const Reporter& reporter) const;
  [[nodiscard]] std::string words_of(const StateCondition& condition) const;

  const CompiledCatalog& catalog_;
  const ConditionFormula formulas_;
};

}  // namespace cbc
