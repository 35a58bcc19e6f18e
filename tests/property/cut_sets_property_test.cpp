// Random catalogs: the minimal cut sets of every task must be those that a look at every set of
// behaviors and every assignment finds. CBC_SEED and CBC_PROPERTY_CASES are as in
// lint_property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_text.h"
#include "demand.h"
#include "enumeration.h"
#include "lint_generator.h"
#include "lint_oracle.h"
#include "random.h"
#include "random_cases.h"
#include "runtime/compiled/compiled_catalog.h"
#include "statistics.h"
#include "verify/engine/cut_sets.h"
#include "yaml_text.h"

namespace cbc::oracle::cut_sets_property_test {
namespace {

constexpr std::uint64_t default_cases = 1000;

/// Behaviors of the model, one bit each.
using Set = std::uint64_t;

constexpr Set bit(std::size_t behavior) { return Set{1} << behavior; }

class Check {
 public:
  Check(const LintOracle& oracle, const CompiledCatalog& compiled, Random& random,
        Statistics& statistics)
      : oracle_(oracle),
        facts_(oracle.facts()),
        catalog_(facts_.catalog),
        compiled_(compiled),
        random_(random),
        statistics_(statistics) {}

  void check() {
    const std::optional<SituationPart> part = draw_situation();
    ruled_out_ = ruled_out_by(compiled_, part);
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      find_supports(task);
      check_cut_sets(task);
    }
  }

 private:
  TaskId id_of_task(std::size_t task) const {
    return compiled_.task_ids[*compiled_.find_task(catalog_.tasks[task].name)];
  }
  BehaviorId id_of_behavior(std::size_t behavior) const {
    return compiled_.behavior_ids[*compiled_.find_behavior(catalog_.behaviors[behavior].name)];
  }

  /// Sets `out_`, the behaviors that do not count, by the model.
  std::optional<SituationPart> draw_situation() {
    if (random_.percent(40)) return std::nullopt;
    statistics_.count("situation");
    SituationPart part;
    std::vector<std::optional<std::size_t>> fixed(catalog_.variables.size());
    for (std::size_t variable = 0; variable < fixed.size(); ++variable) {
      if (random_.percent(30)) continue;
      fixed[variable] = random_.below(catalog_.variables[variable].value_count());
      part.variables.push_back({*compiled_.find_variable(catalog_.variables[variable].name),
                                static_cast<std::uint32_t>(*fixed[variable])});
    }
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      for (const Condition& condition : catalog_.behaviors[behavior].situation) {
        const auto& value = fixed[condition.variable];
        const auto& fitting = condition.values;
        if (value && std::find(fitting.begin(), fitting.end(), *value) == fitting.end()) {
          out_ |= bit(behavior);
        }
      }
      if (!random_.percent(10)) continue;
      const bool available = random_.percent(30);
      if (!available) out_ |= bit(behavior);
      part.behaviors.push_back({id_of_behavior(behavior), available});
    }
    return part;
  }

  /// The active behaviors of each assignment that runs the task.
  void find_supports(std::size_t task) {
    std::set<Set> supports;
    const std::size_t group = facts_.group_of[task];
    static_cast<void>(oracle_.any(group, oracle_.all(group), [&](const Row& row) {
      if (row.values[task] == none) return false;
      Set active = 0;
      for (const std::size_t value : row.values) {
        if (value != none) active |= bit(value);
      }
      if ((active & out_) == 0) supports.insert(active);
      return false;
    }));
    supports_.assign(supports.begin(), supports.end());
  }

  bool is_impossible_without(Set faulty) const {
    return std::none_of(supports_.begin(), supports_.end(),
                        [faulty](Set support) { return (support & faulty) == 0; });
  }

  /// By size, then in catalog order.
  std::vector<std::vector<std::size_t>> minimal_cut_sets(std::size_t task,
                                                         std::size_t order) const {
    std::vector<std::size_t> behaviors;
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      if (facts_.group_of_behavior(behavior) == facts_.group_of[task])
        behaviors.push_back(behavior);
    }
    std::vector<std::vector<std::size_t>> found;
    std::vector<std::vector<std::size_t>> sets{{}};
    for (std::size_t size = 0; size <= order; ++size) {
      std::vector<std::vector<std::size_t>> larger;
      for (const std::vector<std::size_t>& set : sets) {
        if (is_minimal_cut_set(set)) found.push_back(set);
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

  bool is_minimal_cut_set(const std::vector<std::size_t>& set) const {
    Set faulty = 0;
    for (const std::size_t behavior : set) faulty |= bit(behavior);
    return is_impossible_without(faulty) &&
           std::none_of(set.begin(), set.end(), [&](std::size_t behavior) {
             return is_impossible_without(faulty & ~bit(behavior));
           });
  }

  void check_cut_sets(std::size_t task) {
    CutSetOptions options;
    options.order = static_cast<std::uint32_t>(random_.below(5));
    const CutSets found = find_cut_sets(compiled_, id_of_task(task), ruled_out_, options);
    std::vector<std::vector<BehaviorId>> expected;
    for (const std::vector<std::size_t>& set : minimal_cut_sets(task, options.order)) {
      std::vector<BehaviorId> ids;
      ids.reserve(set.size());
      for (const std::size_t behavior : set) ids.push_back(id_of_behavior(behavior));
      expected.push_back(std::move(ids));
      statistics_.count("cut set of " + std::to_string(set.size()));
    }
    demand(found.complete, "not complete");
    demand(found.sets == expected, "other cut sets of '" + catalog_.tasks[task].name + "'");
  }

  const LintOracle& oracle_;
  const CatalogFacts& facts_;
  const Catalog& catalog_;
  const CompiledCatalog& compiled_;
  Random& random_;
  Statistics& statistics_;
  Set out_ = 0;
  std::vector<bool> ruled_out_;  ///< by BehaviorId
  std::vector<Set> supports_;
};

void add_situation(Catalog& catalog, Random& random) {
  const std::size_t count = random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    Variable variable{"V" + std::to_string(i), {}};
    if (random.percent(50)) variable.values = {"red", "green", "blue"};
    catalog.variables.push_back(variable);
  }
  for (Behavior& behavior : catalog.behaviors) {
    for (std::size_t variable = 0; variable < count; ++variable) {
      if (!random.percent(30)) continue;
      Condition condition{variable, {}};
      const std::size_t values = catalog.variables[variable].value_count();
      const std::size_t first = random.below(values);
      condition.values.push_back(first);
      if (values > 2 && random.percent(50)) condition.values.push_back((first + 1) % values);
      behavior.situation.push_back(condition);
    }
  }
}

void run_case(std::uint64_t seed, Results& results) {
  Random random(seed);
  Catalog catalog = generate_strict_catalog(random);
  add_situation(catalog, random);
  const std::string yaml = catalog_yaml(catalog, random);
  try {
    const CatalogFacts facts(catalog);
    const LintOracle oracle(facts);
    const std::optional<CompiledCatalog> compiled = compile_yaml(yaml);
    demand(compiled.has_value(), "not understood");
    Check(oracle, *compiled, random, results.statistics).check();
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" + yaml +
                                        "--- fault\n" + error.what() + "\n"});
  }
}

const LowerBound lower_bounds[] = {
    {"situation", 300},    {"cut set of 0", 300}, {"cut set of 1", 1000},
    {"cut set of 2", 300}, {"cut set of 3", 100}, {"cut set of 4", 20},
};

TEST(CutSets, AreThoseOfEnumeration) { run_random_cases(default_cases, run_case, lower_bounds); }

}  // namespace
}  // namespace cbc::oracle::cut_sets_property_test
