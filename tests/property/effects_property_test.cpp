// Random catalogs, with situations of which some never occur: the effects of faults and of changes
// on every task must be those that a look at every set of behaviors and every assignment finds;
// what ends a task must be its minimal cut sets; and where nothing is required that starts on
// request only, a coordinator must start the task in the same way. CBC_SEED and
// CBC_PROPERTY_CASES are as in lint_property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_model.h"
#include "demand.h"
#include "enumeration.h"
#include "random.h"
#include "random_cases.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "statistics.h"
#include "verify/engine/effects.h"
#include "verify/report/verify_report.h"

namespace cbc::oracle::effects_property_test {
namespace {

constexpr std::uint64_t default_cases = 1000;

/// Behaviors of the model, ascending.
using Faults = std::vector<std::size_t>;

/// The values of all tasks of the model, or nothing if the task cannot run.
using Best = std::optional<Assignment>;

/// What goes wrong, and the best assignment then.
struct ModelEffect {
  Faults faults;
  std::optional<std::pair<std::size_t, std::size_t>> change;
  Best best;
};

class Ignore final : public EventListener {
 public:
  void on_event(const EventRecord& /*record*/) override {}
};

class Check : private CompiledModel {
 public:
  Check(const CatalogFacts& facts, const CompiledCatalog& compiled, Random& random,
        Statistics& statistics)
      : CompiledModel(facts.catalog, compiled),
        facts_(facts),
        random_(random),
        statistics_(statistics) {}

  void check() {
    draw_situation();
    EffectOptions options;
    options.order = static_cast<std::uint32_t>(1 + random_.below(3));
    if (random_.percent(50)) changes_ = changes_of(compiled_, given_, never_);
    has_changes_ = !changes_.empty();
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      task_ = task;
      const TaskEffects found =
          find_effects(compiled_, id_of_task(task), given_, changes_, options);
      demand(found.complete, "not complete");
      compare(found, options);
      compare_with_cut_sets(found, options);
      compare_all(found, options);
    }
  }

 private:
  BehaviorSet ids_of(const Faults& faults) const {
    BehaviorSet ids;
    for (const std::size_t behavior : faults) ids.push_back(id_of_behavior(behavior));
    return ids;
  }

  void draw_situation() {
    own_.assign(catalog_.behaviors.size(), true);
    for (const Variable& variable : catalog_.variables) {
      values_.push_back(random_.below(variable.value_count()));
    }
    SituationPart given;
    for (std::size_t variable = 0; variable < values_.size(); ++variable) {
      // Of those that have their first values some are not given.
      if (values_[variable] == 0 && random_.percent(50)) continue;
      given.variables.push_back(id_of_value(variable, values_[variable]));
    }
    for (std::size_t behavior = 0; behavior < own_.size(); ++behavior) {
      if (!random_.percent(5)) continue;
      own_[behavior] = false;
      given.behaviors.push_back({id_of_behavior(behavior), false});
    }
    given_ = complete_situation(compiled_, given);
    if (catalog_.variables.empty() || random_.percent(50)) return;
    // A value that a variable never has, but for its present one.
    const std::size_t variable = random_.below(values_.size());
    const std::size_t value = random_.below(catalog_.variables[variable].value_count());
    if (value == values_[variable]) return;
    excluded_ = {variable, value};
    never_.push_back({{id_of_value(variable, value)}, {}});
  }

  Best best_of(const Faults& faults, const std::vector<std::size_t>& values) const {
    Problem problem;
    problem.group = facts_.group_of[task_];
    for (const std::size_t task : facts_.groups[problem.group]) {
      std::vector<std::size_t>& domain = problem.domains.emplace_back();
      if (task != task_) domain.push_back(none);
      for (const std::size_t behavior : facts_.behaviors_of[task]) {
        const bool is_faulty = std::find(faults.begin(), faults.end(), behavior) != faults.end();
        if (!is_faulty && own_[behavior] && facts_.fits(behavior, values)) {
          domain.push_back(behavior);
        }
      }
    }
    problem.requests.push_back({task_, 1, 1});
    problem.before.assign(catalog_.tasks.size(), none);
    const std::optional<Solution> solution = solve(facts_, problem, nullptr);
    return solution ? Best(solution->values) : Best();
  }

  /// All sets of up to so many behaviors of the group, the smaller ones first, then in order.
  std::vector<Faults> all_faults(std::size_t order) const {
    std::vector<Faults> all{{}};
    for (std::size_t place = 0; place < all.size(); ++place) {
      if (all[place].size() == order) continue;
      for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
        if (facts_.group_of_behavior(behavior) != facts_.group_of[task_]) continue;
        if (!all[place].empty() && behavior <= all[place].back()) continue;
        Faults larger = all[place];
        larger.push_back(behavior);
        all.push_back(std::move(larger));
      }
    }
    all.erase(all.begin());
    return all;
  }

  /// All effects by their definition, those that change nothing included.
  std::vector<ModelEffect> effects_of_model(const EffectOptions& options) {
    best_ = best_of({}, values_);
    if (!best_) return {{}};
    std::map<Faults, Best> known;
    std::vector<ModelEffect> effects;
    for (const Faults& faults : all_faults(options.order)) {
      const Best best = best_of(faults, values_);
      const bool is_of_part = std::any_of(known.begin(), known.end(), [&](const auto& other) {
        return other.second == best &&
               std::includes(faults.begin(), faults.end(), other.first.begin(), other.first.end());
      });
      known.emplace(faults, best);
      if (!is_of_part) effects.push_back({faults, {}, best});
    }
    for (std::size_t variable = 0; has_changes_ && variable < values_.size(); ++variable) {
      for (std::size_t value = 0; value < catalog_.variables[variable].value_count(); ++value) {
        if (value == values_[variable]) continue;
        if (excluded_ == std::pair(variable, value)) continue;
        std::vector<std::size_t> changed = values_;
        changed[variable] = value;
        effects.push_back({{}, std::pair(variable, value), best_of({}, changed)});
      }
    }
    return effects;
  }

  void demand_same(const BestAssignment& found, const Best& expected) const {
    demand(found.has_value() == expected.has_value(), "whether the task runs");
    if (!found) return;
    const TaskId first = compiled_.group_tasks[compiled_.tasks[id_of_task(task_)].group];
    for (const std::size_t task : facts_.groups[facts_.group_of[task_]]) {
      const TaskId id = id_of_task(task);
      const std::uint32_t index = (*found)[id - first];
      const std::size_t value = (*expected)[task];
      demand((index == cbc::none) == (value == none), "whether a task runs");
      if (value == none) continue;
      demand(compiled_.values[id][index].behavior == id_of_behavior(value), "another behavior");
    }
  }

  void compare(const TaskEffects& found, const EffectOptions& options) {
    effects_ = effects_of_model(options);
    demand_same(found.best, best_);
    std::vector<ModelEffect> expected;
    std::copy_if(effects_.begin(), effects_.end(), std::back_inserter(expected),
                 [&](const ModelEffect& effect) { return !best_ || effect.best != best_; });
    demand(found.effects.size() == expected.size(), "another number of effects");
    for (std::size_t place = 0; place < expected.size(); ++place) {
      compare_effect(found.effects[place], expected[place]);
      check_coordinator(expected[place]);
    }
  }

  void compare_effect(const Effect& found, const ModelEffect& expected) {
    demand(found.faults == ids_of(expected.faults), "other faults");
    std::vector<VariableValue> change;
    if (expected.change) {
      change.push_back(id_of_value(expected.change->first, expected.change->second));
    }
    demand(found.situation == change, "another change");
    const Effect::Kind kind = !expected.best                    ? Effect::Kind::lost
                              : best_ && expected.best == best_ ? Effect::Kind::unchanged
                                                                : Effect::Kind::degraded;
    demand(found.kind == kind, "another kind of effect");
    demand_same(found.best, expected.best);
    statistics_.count(std::string(name_of(kind)) +
                      (!found.situation.empty()
                           ? " by a change"
                           : " by faults: " + std::to_string(found.faults.size())));
  }

  void compare_with_cut_sets(const TaskEffects& found, const EffectOptions& options) const {
    const TaskEffects sets =
        find_cut_sets(SituationSpace(compiled_, given_, {}), found.task, options);
    std::vector<Effect> lost;
    for (const Effect& effect : found.effects) {
      if (effect.kind == Effect::Kind::lost && effect.situation.empty()) lost.push_back(effect);
    }
    demand(lost == sets.effects, "what is lost is not the minimal cut sets");
  }

  /// The whole table has single behaviors of all groups, and changes of all variables.
  void compare_all(const TaskEffects& found, const EffectOptions& options) {
    ReportedEffects report;
    report.order = options.order;
    report.changes = changes_;
    const std::vector<Effect> all = report.all_of(compiled_, found);
    if (!best_) return demand(all.size() == 1, "of what never runs there is one effect");
    std::vector<ModelEffect> expected;
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      expected.push_back({{behavior}, {}, best_of({behavior}, values_)});
    }
    std::copy_if(effects_.begin(), effects_.end(), std::back_inserter(expected),
                 [](const ModelEffect& effect) { return effect.faults.size() != 1; });
    demand(all.size() == expected.size(), "another number of all effects");
    for (std::size_t place = 0; place < all.size(); ++place) {
      compare_effect(all[place], expected[place]);
    }
  }

  bool requires_what_starts_on_request() const {
    return std::any_of(
        catalog_.behaviors.begin(), catalog_.behaviors.end(), [&](const Behavior& behavior) {
          return std::any_of(behavior.requirements.begin(), behavior.requirements.end(),
                             [&](const Requirement& requirement) {
                               return catalog_.tasks[requirement.task].start_on_request;
                             });
        });
  }

  /// A behavior may perform tasks that start on request only beside the one in question.
  bool performs_several() const {
    return std::any_of(catalog_.behaviors.begin(), catalog_.behaviors.end(),
                       [](const Behavior& behavior) { return behavior.performs.size() > 1; });
  }

  void check_coordinator(const ModelEffect& effect) {
    if (requires_what_starts_on_request() || performs_several()) return;
    SituationPart situation = given_;
    if (effect.change) {
      for (VariableValue& value : situation.variables) {
        const VariableValue change = id_of_value(effect.change->first, effect.change->second);
        if (value.variable == change.variable) value = change;
      }
    }
    std::vector<Availability> own;
    for (std::size_t behavior = 0; behavior < own_.size(); ++behavior) {
      own.push_back({*compiled_.find_behavior(catalog_.behaviors[behavior].name), own_[behavior]});
    }
    Ignore ignore;
    CoordinatorOptions options;
    Coordinator coordinator(compiled_, options, ignore);
    coordinator.begin(own, situation.variables);
    for (const std::size_t behavior : effect.faults) {
      cbc::Event fault;
      fault.verb = cbc::Verb::fault;
      fault.subject = *compiled_.find_behavior(catalog_.behaviors[behavior].name);
      static_cast<void>(coordinator.handle(fault));
    }
    cbc::Event start;
    start.verb = cbc::Verb::start;
    start.subject = *compiled_.find_task(catalog_.tasks[task_].name);
    demand(coordinator.handle(start) == Coordinator::Status::ok, "the coordinator failed");
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      const std::size_t value = effect.best ? (*effect.best)[task] : none;
      const BehaviorId active = coordinator.state().behavior(id_of_task(task));
      demand(active == (value == none ? BehaviorId(cbc::none) : id_of_behavior(value)),
             "the coordinator starts it otherwise");
    }
    statistics_.count("started by a coordinator");
  }

  const CatalogFacts& facts_;
  Random& random_;
  Statistics& statistics_;
  std::vector<bool> own_;
  std::vector<std::size_t> values_;  ///< of the variables
  SituationPart given_;
  std::vector<SituationPart> never_;
  std::vector<VariableValue> changes_;
  bool has_changes_ = false;  ///< whether changes are asked for, and there are any
  std::optional<std::pair<std::size_t, std::size_t>> excluded_;
  std::size_t task_ = 0;
  Best best_;  ///< without faults
  std::vector<ModelEffect> effects_;
};

void run_case(std::uint64_t seed, Results& results) {
  run_situation_case(seed, results, true,
                     [&](const Catalog& catalog, const CompiledCatalog& compiled, Random& random) {
                       const CatalogFacts facts(catalog);
                       Check(facts, compiled, random, results.statistics).check();
                     });
}

const LowerBound lower_bounds[] = {
    {"lost by faults: 0", 500},  {"lost by faults: 1", 1000},       {"lost by faults: 2", 100},
    {"lost by faults: 3", 10},   {"degraded by faults: 1", 500},    {"degraded by faults: 2", 50},
    {"none by faults: 1", 1000}, {"lost by a change", 50},          {"degraded by a change", 30},
    {"none by a change", 100},   {"started by a coordinator", 100},
};

TEST(Effects, AreThoseOfEnumeration) { run_random_cases(default_cases, run_case, lower_bounds); }

}  // namespace
}  // namespace cbc::oracle::effects_property_test
