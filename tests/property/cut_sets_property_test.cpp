// Random catalogs, with situations of which some never occur: the minimal cut sets of every task,
// in every situation and in some, must be those that a look at every set of behaviors, every
// situation and every assignment finds. CBC_SEED and CBC_PROPERTY_CASES are as in
// lint_property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_model.h"
#include "demand.h"
#include "enumeration.h"
#include "lint_oracle.h"
#include "random.h"
#include "random_cases.h"
#include "runtime/compiled/compiled_catalog.h"
#include "statistics.h"
#include "verify/engine/effects.h"

namespace cbc::oracle::cut_sets_property_test {
namespace {

constexpr std::uint64_t default_cases = 1000;

/// Behaviors of the model, or situations, one bit each.
using Set = std::uint64_t;

constexpr Set bit(std::size_t place) { return Set{1} << place; }

/// Values of some variables of the model, in the order of the variables.
using Values = std::vector<std::pair<std::size_t, std::size_t>>;

/// A cut set of the model: behaviors, ascending, and the values under which they suffice.
using SituatedSet = std::pair<std::vector<std::size_t>, Values>;

class Check : private CompiledModel {
 public:
  Check(const LintOracle& oracle, const CompiledCatalog& compiled, Random& random,
        Statistics& statistics)
      : CompiledModel(oracle.facts().catalog, compiled),
        oracle_(oracle),
        facts_(oracle.facts()),
        random_(random),
        statistics_(statistics) {}

  void check() {
    enumerate_situations();
    draw_given();
    draw_never();
    if (allowed_ == 0) return statistics_.count("no situation");
    const SituationSpace situations(compiled_, given_, never_);
    demand(situations.find(situations.all()).has_value(), "no situation was found");
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      find_supports(task);
      check_cut_sets(situations, task);
    }
  }

 private:
  void enumerate_situations() {
    situations_ = {{}};
    for (const Variable& variable : catalog_.variables) {
      std::vector<std::vector<std::size_t>> longer;
      for (const std::vector<std::size_t>& situation : situations_) {
        for (std::size_t value = 0; value < variable.value_count(); ++value) {
          longer.push_back(situation);
          longer.back().push_back(value);
        }
      }
      situations_ = std::move(longer);
    }
    allowed_ = situations_.size() == 64 ? ~Set{0} : bit(situations_.size()) - 1;
  }

  /// The situations in which the variables have these values.
  Set situations_with(const Values& values) const {
    Set found = 0;
    for (std::size_t place = 0; place < situations_.size(); ++place) {
      const bool agrees = std::all_of(values.begin(), values.end(), [&](const auto& value) {
        return situations_[place][value.first] == value.second;
      });
      if (agrees) found |= bit(place);
    }
    return found;
  }

  void draw_given() {
    own_.assign(catalog_.behaviors.size(), true);
    is_free_.assign(catalog_.variables.size(), true);
    if (random_.percent(40)) return;
    statistics_.count("given");
    for (std::size_t variable = 0; variable < catalog_.variables.size(); ++variable) {
      if (random_.percent(60)) continue;
      is_free_[variable] = false;
      const std::size_t value = random_.below(catalog_.variables[variable].value_count());
      allowed_ &= situations_with({{variable, value}});
      given_.variables.push_back(id_of_value(variable, value));
    }
    for (std::size_t behavior = 0; behavior < own_.size(); ++behavior) {
      if (!random_.percent(10)) continue;
      own_[behavior] = random_.percent(30);
      given_.behaviors.push_back({id_of_behavior(behavior), own_[behavior]});
    }
  }

  void draw_never() {
    const std::size_t count = random_.below(4);
    for (std::size_t i = 0; i < count; ++i) {
      SituationPart part;
      Values values;
      bool is_about_own = true;  // holds, as far as own(b) goes
      for (std::size_t variable = 0; variable < catalog_.variables.size(); ++variable) {
        if (random_.percent(40)) continue;
        values.emplace_back(variable, random_.below(catalog_.variables[variable].value_count()));
        part.variables.push_back(id_of_value(variable, values.back().second));
      }
      if (!own_.empty() && random_.percent(20)) {
        const std::size_t behavior = random_.below(catalog_.behaviors.size());
        const bool available = random_.percent(50);
        is_about_own = available == own_[behavior];
        part.behaviors.push_back({id_of_behavior(behavior), available});
      }
      if (part.variables.empty() && part.behaviors.empty()) continue;
      if (is_about_own) allowed_ &= ~situations_with(values);
      never_.push_back(std::move(part));
      statistics_.count("never");
    }
  }

  /// By allowed situation, the active behaviors of each assignment that runs the task there.
  void find_supports(std::size_t task) {
    supports_.assign(situations_.size(), {});
    const std::size_t group = facts_.group_of[task];
    static_cast<void>(oracle_.any(group, oracle_.all(group), [&](const Row& row) {
      if (row.values[task] == none) return false;
      Set active = 0;
      for (const std::size_t value : row.values) {
        if (value != none) active |= bit(value);
      }
      for (std::size_t place = 0; place < situations_.size(); ++place) {
        bool is_possible = (allowed_ & bit(place)) != 0;
        for (std::size_t behavior = 0; is_possible && behavior < own_.size(); ++behavior) {
          if ((active & bit(behavior)) == 0) continue;
          is_possible = own_[behavior] && facts_.fits(behavior, situations_[place]);
        }
        if (is_possible) supports_[place].insert(active);
      }
      return false;
    }));
  }

  /// The situations in which the task cannot run without these behaviors.
  Set cut_by(const std::vector<std::size_t>& behaviors) const {
    Set faulty = 0;
    for (const std::size_t behavior : behaviors) faulty |= bit(behavior);
    Set cut = 0;
    for (std::size_t place = 0; place < situations_.size(); ++place) {
      const bool is_cut = std::none_of(supports_[place].begin(), supports_[place].end(),
                                       [faulty](Set support) { return (support & faulty) == 0; });
      if (is_cut) cut |= bit(place);
    }
    return cut;
  }

  bool suffice(const std::vector<std::size_t>& behaviors, const Values& values) const {
    return (situations_with(values) & allowed_ & ~cut_by(behaviors)) == 0;
  }

  template <typename List>
  static List without(const List& list, std::size_t place) {
    List rest = list;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(place));
    return rest;
  }

  bool is_minimal(const std::vector<std::size_t>& behaviors, const Values& values) const {
    if (!suffice(behaviors, values)) return false;
    for (std::size_t place = 0; place < behaviors.size(); ++place) {
      if (suffice(without(behaviors, place), values)) return false;
    }
    for (std::size_t place = 0; place < values.size(); ++place) {
      if (suffice(behaviors, without(values, place))) return false;
    }
    return true;
  }

  /// Values of free variables that some allowed situation has together.
  std::vector<Values> all_values() const {
    std::vector<Values> all{{}};
    for (std::size_t variable = 0; variable < is_free_.size(); ++variable) {
      if (!is_free_[variable]) continue;
      const std::size_t count = all.size();
      for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t value = 0; value < catalog_.variables[variable].value_count(); ++value) {
          Values longer = all[i];
          longer.emplace_back(variable, value);
          if ((situations_with(longer) & allowed_) != 0) all.push_back(std::move(longer));
        }
      }
    }
    std::sort(all.begin(), all.end());
    return all;
  }

  /// By size, then in catalog order, then by the values.
  std::vector<SituatedSet> minimal_cut_sets(std::size_t task, std::size_t order,
                                            const std::vector<Values>& all_values) const {
    std::vector<std::size_t> behaviors;
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      if (facts_.group_of_behavior(behavior) == facts_.group_of[task])
        behaviors.push_back(behavior);
    }
    std::vector<SituatedSet> found;
    std::vector<std::vector<std::size_t>> sets{{}};
    for (std::size_t size = 0; size <= order; ++size) {
      std::vector<std::vector<std::size_t>> larger;
      for (const std::vector<std::size_t>& set : sets) {
        for (const Values& values : all_values) {
          if (is_minimal(set, values)) found.emplace_back(set, values);
        }
        for (const std::size_t behavior : behaviors) {
          if (!set.empty() && behavior <= set.back()) continue;
          larger.push_back(set);
          larger.back().push_back(behavior);
        }
      }
      sets = std::move(larger);
    }
    return found;
  }

  void check_cut_sets(const SituationSpace& situations, std::size_t task) {
    EffectOptions options;
    options.in_some_situation = random_.percent(40);
    options.order = static_cast<std::uint32_t>(random_.below(5));
    const TaskEffects found = find_cut_sets(situations, id_of_task(task), options);
    std::vector<Effect> expected;
    const std::vector<Values> values =
        options.in_some_situation ? all_values() : std::vector<Values>{{}};
    for (const SituatedSet& set : minimal_cut_sets(task, options.order, values)) {
      Effect& added = expected.emplace_back();
      for (const std::size_t behavior : set.first) {
        added.faults.push_back(id_of_behavior(behavior));
      }
      for (const auto& [variable, value] : set.second) {
        added.situation.push_back(id_of_value(variable, value));
      }
      statistics_.count("cut set of " + std::to_string(set.first.size()) +
                        (set.second.empty() ? "" : " in some situation"));
    }
    demand(found.complete, "not complete");
    demand(found.effects == expected, "other cut sets of '" + catalog_.tasks[task].name + "'");
  }

  const LintOracle& oracle_;
  const CatalogFacts& facts_;
  Random& random_;
  Statistics& statistics_;
  std::vector<std::vector<std::size_t>> situations_;  ///< all, each by variable
  Set allowed_ = 0;                                   ///< situations
  std::vector<bool> own_;
  std::vector<bool> is_free_;  ///< by variable
  SituationPart given_;
  std::vector<SituationPart> never_;
  std::vector<std::set<Set>> supports_;  ///< by situation
};

void run_case(std::uint64_t seed, Results& results) {
  run_situation_case(seed, results, false,
                     [&](const Catalog& catalog, const CompiledCatalog& compiled, Random& random) {
                       const CatalogFacts facts(catalog);
                       const LintOracle oracle(facts);
                       Check(oracle, compiled, random, results.statistics).check();
                     });
}

const LowerBound lower_bounds[] = {
    {"given", 300},
    {"never", 500},
    {"cut set of 0", 300},
    {"cut set of 1", 1000},
    {"cut set of 2", 300},
    {"cut set of 3", 100},
    {"cut set of 4", 20},
    {"cut set of 0 in some situation", 100},
    {"cut set of 1 in some situation", 300},
    {"cut set of 2 in some situation", 100},
    {"cut set of 3 in some situation", 5},
};

TEST(CutSets, AreThoseOfEnumeration) { run_random_cases(default_cases, run_case, lower_bounds); }

}  // namespace
}  // namespace cbc::oracle::cut_sets_property_test
