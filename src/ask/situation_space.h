#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cbc/event.h"
#include "runtime/compiled/compiled_catalog.h"

// Which situations count where a question is about more than one, and whether some behaviors fit in
// a common one.

namespace cbc {

/// Values of situation variables, and answers of check_situation (own(b)); all of them hold.
struct SituationPart {
  struct Own {
    BehaviorId behavior;
    bool available = true;
  };
  std::vector<VariableValue> variables;
  std::vector<Own> behaviors;
};

/// Some situations: of each situation variable the values that it may have, independently of the
/// others. A flag (0 or 1) for each value, by its place in CompiledCatalog::variable_values.
using ValueSets = std::vector<std::uint8_t>;

/// The value of each situation variable.
using VariableValues = std::vector<std::uint32_t>;

/// Some conditions of behaviors: a flag for each value in which a behavior fits, by its place in
/// CompiledCatalog::fitting_values.
using ConditionSet = std::vector<std::uint8_t>;
[[nodiscard]] inline std::size_t place_of(const CompiledCatalog& catalog,
                                          const FittingValue& value) {
  return static_cast<std::size_t>(&value - catalog.fitting_values.data());
}

/// The situations that agree with what is given of one, and that no entry of `never` excludes.
/// Answers of check_situation (own(b)) that are not given are true.
class SituationSpace {
 public:
  /// `given`: its variables have these values. `never`: in an entry, values of one variable are
  /// alternatives. The catalog must outlive this object.
  SituationSpace(const CompiledCatalog& catalog, const SituationPart& given,
                 std::span<const SituationPart> never);

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }

  /// All values that the given part leaves, those that `never` excludes included.
  [[nodiscard]] const ValueSets& all() const { return all_; }
  /// Whether own(b) is true.
  [[nodiscard]] bool is_available(BehaviorId behavior) const { return denied_[behavior] == 0; }
  /// The behaviors of which it is not, ascending.
  [[nodiscard]] const std::vector<BehaviorId>& denied() const { return denied_behaviors_; }
  /// Whether the given part leaves a variable more than one value.
  [[nodiscard]] bool is_free(std::uint32_t variable) const { return is_free_[variable] != 0; }

  /// Takes the values out of the sets in which a behavior does not fit. `only`: the conditions that
  /// count; null: all.
  void restrict(BehaviorId behavior, ValueSets& sets, const ConditionSet* only = nullptr) const;
  /// Leaves a variable only one value.
  void restrict(VariableValue value, ValueSets& sets) const;
  /// Whether a behavior fits in some of the situations, be they excluded or not. `fitting`: its
  /// values, or those of one of its conditions.
  [[nodiscard]] bool may_fit(std::span<const FittingValue> fitting, const ValueSets& sets) const;

  /// One of the situations that is not excluded, or nothing if there is none.
  [[nodiscard]] std::optional<VariableValues> find(ValueSets sets) const;

  /// The variables that behaviors name, and those that `never` ties to them, directly or through
  /// others; ascending. Those that have only one value are left out. What other variables may be
  /// does not depend on whether the behaviors fit.
  [[nodiscard]] std::vector<std::uint32_t> variables_of(
      std::span<const BehaviorId> behaviors) const;

 private:
  /// A variable, and the values of it that are part of an entry of `never`.
  struct Literal {
    std::uint32_t variable = 0;
    std::vector<std::uint32_t> values;  ///< ascending
  };
  using Entry = std::vector<Literal>;

  void add_never(const SituationPart& part);
  [[nodiscard]] std::uint32_t first_value(std::uint32_t variable) const {
    return catalog_.variables[variable].first_value;
  }
  [[nodiscard]] std::uint32_t tie_of(std::uint32_t variable) const;
  [[nodiscard]] bool choose(const ValueSets& sets, VariableValues& values) const;
  [[nodiscard]] const Entry* find_violated(const VariableValues& values) const;

  const CompiledCatalog& catalog_;
  ValueSets all_;
  std::vector<std::uint8_t> denied_;  ///< by behavior
  std::vector<BehaviorId> denied_behaviors_;
  std::vector<std::uint8_t> is_free_;  ///< by variable
  std::vector<Entry> never_;           ///< that are not decided by the given part
  std::vector<std::uint32_t> ties_;    ///< by variable: another one of its class, or itself
};

}  // namespace cbc
