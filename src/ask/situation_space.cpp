// Of some situations one that no entry of `never` excludes is found by repair: every variable takes
// its first value; if an entry excludes that, one of its variables must have a value outside of it,
// and each of them is tried, as in the DPLL procedure (M. Davis, G. Logemann and D. Loveland, "A
// machine program for theorem-proving", Communications of the ACM 5 (1962)). So the effort depends
// on the entries that matter, and not on how many situations there are.

#include "ask/situation_space.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

namespace cbc {

SituationSpace::SituationSpace(const CompiledCatalog& catalog, const SituationPart& given,
                               std::span<const SituationPart> never)
    : catalog_(catalog),
      all_(catalog.variable_values.size(), 1),
      denied_(catalog.behaviors.size(), 0),
      is_free_(catalog.variables.size(), 1),
      ties_(catalog.variables.size()) {
  for (const VariableValue& value : given.variables) {
    restrict(value, all_);
    is_free_[value.variable] = 0;
  }
  for (const SituationPart::Own& own : given.behaviors) {
    denied_[own.behavior] = own.available ? 0 : 1;
  }
  for (BehaviorId behavior(0); behavior < denied_.size(); ++behavior) {
    if (denied_[behavior] != 0) denied_behaviors_.push_back(behavior);
  }
  std::iota(ties_.begin(), ties_.end(), 0U);
  for (const SituationPart& part : never) add_never(part);
}

/// What is given decides some parts of an entry: one that does not hold makes it exclude nothing.
void SituationSpace::add_never(const SituationPart& part) {
  for (const SituationPart::Own& own : part.behaviors) {
    if (own.available != is_available(own.behavior)) return;
  }
  Entry entry;
  for (const VariableValue& value : part.variables) {
    const auto known = std::find_if(entry.begin(), entry.end(), [&](const Literal& literal) {
      return literal.variable == value.variable;
    });
    Literal& literal =
        known != entry.end() ? *known : entry.emplace_back(Literal{value.variable, {}});
    literal.values.push_back(value.value);
  }
  Entry open;
  for (Literal& literal : entry) {
    std::sort(literal.values.begin(), literal.values.end());
    if (is_free(literal.variable)) {
      open.push_back(std::move(literal));
      continue;
    }
    const bool holds = std::any_of(
        literal.values.begin(), literal.values.end(),
        [&](std::uint32_t value) { return all_[first_value(literal.variable) + value] != 0; });
    if (!holds) return;
  }
  for (std::size_t place = 1; place < open.size(); ++place) {
    ties_[tie_of(open[place].variable)] = tie_of(open.front().variable);
  }
  never_.push_back(std::move(open));
}

/// The variable that stands for the class.
std::uint32_t SituationSpace::tie_of(std::uint32_t variable) const {
  while (ties_[variable] != variable) variable = ties_[variable];
  return variable;
}

void SituationSpace::restrict(BehaviorId behavior, ValueSets& sets,
                              const ConditionSet* only) const {
  const auto fitting = catalog_.fitting_values_of(behavior);
  for (auto next = fitting.begin(); next != fitting.end();) {
    const std::uint32_t variable = next->variable;
    if (only != nullptr && (*only)[place_of(catalog_, *next)] == 0) {
      ++next;
      continue;
    }
    for (std::uint32_t value = 0; value < catalog_.variables[variable].value_count; ++value) {
      const bool fits = next != fitting.end() && next->variable == variable && next->value == value;
      if (fits) {
        ++next;
      } else {
        sets[first_value(variable) + value] = 0;
      }
    }
  }
}

void SituationSpace::restrict(VariableValue value, ValueSets& sets) const {
  const CompiledVariable& variable = catalog_.variables[value.variable];
  for (std::uint32_t other = 0; other < variable.value_count; ++other) {
    if (other != value.value) sets[variable.first_value + other] = 0;
  }
}

bool SituationSpace::may_fit(std::span<const FittingValue> fitting, const ValueSets& sets) const {
  for (auto next = fitting.begin(); next != fitting.end();) {
    const std::uint32_t variable = next->variable;
    bool fits = false;
    for (; next != fitting.end() && next->variable == variable; ++next) {
      fits |= sets[first_value(variable) + next->value] != 0;
    }
    if (!fits) return false;
  }
  return true;
}

std::optional<VariableValues> SituationSpace::find(ValueSets sets) const {
  VariableValues values(catalog_.variables.size());
  // The loop goes on with the last variable of a violated entry, the recursion tries the others.
  const std::function<bool(ValueSets&)> repair = [&](ValueSets& open) {
    for (;;) {
      if (!choose(open, values)) return false;
      const Entry* const entry = find_violated(values);
      if (entry == nullptr) return true;
      for (const Literal& literal : *entry) {
        ValueSets outside = open;
        for (const std::uint32_t value : literal.values) {
          outside[first_value(literal.variable) + value] = 0;
        }
        if (&literal == &entry->back()) {
          open = std::move(outside);
          break;
        }
        if (repair(outside)) return true;
        // There is none outside, so it is one of these values.
        for (std::uint32_t value = 0; value < catalog_.variables[literal.variable].value_count;
             ++value) {
          if (!std::binary_search(literal.values.begin(), literal.values.end(), value)) {
            open[first_value(literal.variable) + value] = 0;
          }
        }
      }
      if (entry->empty()) return false;
    }
  };
  if (!repair(sets)) return std::nullopt;
  return values;
}

/// The first value of each variable; false if one has none left.
bool SituationSpace::choose(const ValueSets& sets, VariableValues& values) const {
  for (std::uint32_t variable = 0; variable < values.size(); ++variable) {
    const auto first = sets.begin() + first_value(variable);
    const auto end = first + catalog_.variables[variable].value_count;
    const auto found = std::find(first, end, 1);
    if (found == end) return false;
    values[variable] = static_cast<std::uint32_t>(found - first);
  }
  return true;
}

const SituationSpace::Entry* SituationSpace::find_violated(const VariableValues& values) const {
  const auto holds = [&](const Literal& literal) {
    return std::binary_search(literal.values.begin(), literal.values.end(),
                              values[literal.variable]);
  };
  const auto found = std::find_if(never_.begin(), never_.end(), [&](const Entry& entry) {
    return std::all_of(entry.begin(), entry.end(), holds);
  });
  return found == never_.end() ? nullptr : &*found;
}

std::vector<std::uint32_t> SituationSpace::variables_of(
    std::span<const BehaviorId> behaviors) const {
  std::vector<bool> is_tied(catalog_.variables.size(), false);  // by what stands for the class
  for (const BehaviorId behavior : behaviors) {
    for (const FittingValue& fitting : catalog_.fitting_values_of(behavior)) {
      if (is_free(fitting.variable)) is_tied[tie_of(fitting.variable)] = true;
    }
  }
  std::vector<std::uint32_t> variables;
  for (std::uint32_t variable = 0; variable < is_tied.size(); ++variable) {
    if (is_free(variable) && is_tied[tie_of(variable)]) variables.push_back(variable);
  }
  return variables;
}

}  // namespace cbc
