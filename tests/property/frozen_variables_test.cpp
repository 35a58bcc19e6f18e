// Random small catalogs and assumptions: the variables that `never` keeps from changing must be
// those that have one value in all situations that a plain search reaches; and what is offered to
// change at once must let one of them change. CBC_SEED and CBC_PROPERTY_CASES are as in
// property_test.cpp.
#include "core/property/frozen_variables.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "demand.h"
#include "plain_model.h"
#include "random_cases.h"
#include "verify_case.h"

namespace cbc::plain::frozen_variables_test {
namespace {

using oracle::demand;

constexpr std::uint64_t default_cases = 300;

/// Whether the variable has another value in some situation.
bool changes(const CompiledCatalog& catalog, const Assumptions& assumptions,
             std::uint32_t variable) {
  const PlainModel model(catalog, {}, assumptions, {variable});
  std::vector<Snapshot> states = {model.first_state()};
  std::set<std::string> seen = {model.key(states.front())};
  const std::uint32_t first = states.front().variables[variable];
  for (std::size_t place = 0; place < states.size(); ++place) {
    const Snapshot state = states[place];  // the states may move
    if (state.variables[variable] != first) return true;
    for (const Move& move : model.moves(state)) {
      Snapshot next = model.step(state, move).next;
      if (seen.insert(model.key(next)).second) states.push_back(std::move(next));
    }
  }
  return false;
}

bool is_first_excluded(const CompiledCatalog& catalog, const Assumptions& assumptions) {
  const std::set<std::uint32_t> all(assumptions.variables.begin(), assumptions.variables.end());
  std::vector<GroupId> groups;
  for (GroupId group(0); group < catalog.group_count(); ++group) groups.push_back(group);
  const PlainModel model(catalog, groups, assumptions, all);
  return model.is_excluded(model.first_state());
}

void compare(const VerifyCase& sample, oracle::Statistics& statistics) {
  const CompiledCatalog& catalog = sample.catalog;
  const Assumptions& assumptions = sample.question.assumptions;
  if (is_first_excluded(catalog, assumptions)) return statistics.count("excluded");
  std::set<std::uint32_t> found;
  for (const FrozenVariables& frozen : find_frozen_variables(catalog, assumptions)) {
    found.insert(frozen.variables.begin(), frozen.variables.end());
    Assumptions mended = assumptions;
    if (!frozen.together.empty()) {
      statistics.count("together helps");
      demand(!frozen.entries.empty() && !frozen.coupled.empty(), "nothing is coupled");
      mended.together.push_back(frozen.together);
    } else if (frozen.variables.size() > 1) {
      mended.together.push_back(frozen.variables);
    }
    for (const std::uint32_t one : frozen.variables) {
      const bool is_coupled = std::count(frozen.coupled.begin(), frozen.coupled.end(), one) > 0;
      demand(changes(catalog, mended, one) == is_coupled, "what is offered does something else");
    }
  }
  for (const std::uint32_t variable : assumptions.variables) {
    if (catalog.variables[variable].value_count < 2) continue;
    const bool is_frozen = !changes(catalog, assumptions, variable);
    statistics.count(is_frozen ? "frozen" : "changes");
    demand(found.contains(variable) == is_frozen, std::string(catalog.name_of_variable(variable)) +
                                                      (is_frozen ? " is" : " is not") + " kept");
  }
}

void run_case(std::uint64_t seed, oracle::Results& results) {
  VerifyCase sample;
  try {
    sample = generate_verify_case(seed);
    compare(sample, results.statistics);
  } catch (const std::exception& fault) {
    results.faults.push_back({seed, text_of(sample) + fault.what()});
  }
}

constexpr oracle::LowerBound lower_bounds[] = {
    {"frozen", 20}, {"changes", 300}, {"together helps", 3}};

TEST(FrozenVariables, AreThoseThatNoSituationChanges) {
  oracle::run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::plain::frozen_variables_test
