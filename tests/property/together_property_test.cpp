// Random catalogs in which much is impossible: the table of tasks that can run together must have
// what brute force finds, with minimal reasons; so must never-started and blocked-reactive.
// CBC_SEED and CBC_PROPERTY_CASES are as in lint_property_test.cpp.
#include <algorithm>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "ask/together.h"
#include "core/check/check.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "demand.h"
#include "enumeration.h"
#include "lint_generator.h"
#include "lint_oracle.h"
#include "random.h"
#include "random_cases.h"
#include "runtime/compiled/compiled_catalog.h"
#include "statistics.h"
#include "yaml_text.h"

namespace cbc::oracle::together_property_test {
namespace {

constexpr std::uint64_t default_cases = 1000;

class Check {
 public:
  Check(const LintOracle& oracle, const CompiledCatalog& compiled, Statistics& statistics)
      : oracle_(oracle),
        facts_(oracle.facts()),
        catalog_(facts_.catalog),
        compiled_(compiled),
        statistics_(statistics),
        tasks_(catalog_.tasks.size()),
        behaviors_(catalog_.behaviors.size()) {
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      tasks_[*compiled.find_task(catalog_.tasks[task].name)] = task;
    }
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      behaviors_[*compiled.find_behavior(catalog_.behaviors[behavior].name)] = behavior;
    }
  }

  void check_table(const TogetherTable& table) const {
    std::vector<std::size_t> able;
    std::vector<std::size_t> unable;
    const bool takes_all = std::none_of(catalog_.tasks.begin(), catalog_.tasks.end(),
                                        [](const Task& task) { return task.start_on_request; });
    for (const std::size_t task : tasks_) {
      if (catalog_.tasks[task].start_on_request || takes_all) {
        (can_run(task) ? able : unable).push_back(task);
      }
    }
    demand(table.is_of_all_tasks == takes_all, "wrong about whether it is of all tasks");
    if (takes_all) statistics_.count("of all tasks");
    demand(in_model(table.tasks) == able, "the table has other tasks");
    demand(in_model(table.never_run) == unable, "other tasks never run");
    std::size_t pair = 0;
    for (std::size_t a = 0; a < able.size(); ++a) {
      for (std::size_t b = a + 1; b < able.size(); ++b, ++pair) {
        check_pair(table.pairs.at(pair), able[a], able[b]);
      }
    }
    demand(table.pairs.size() == pair, "too many pairs");
  }

  void check_findings(const std::vector<Diagnostic>& findings) const {
    check_rule(findings, "never-started", never_started());
    check_rule(findings, "blocked-reactive", blocked_reactive());
  }

 private:
  std::size_t in_model(TaskId task) const { return tasks_[compiled_.tasks[task].catalog_index]; }

  std::vector<std::size_t> in_model(const std::vector<TaskId>& tasks) const {
    std::vector<std::size_t> all;
    all.reserve(tasks.size());
    for (const TaskId task : tasks) all.push_back(in_model(task));
    return all;
  }

  std::string name_of(std::size_t task) const { return "'" + catalog_.tasks[task].name + "'"; }

  bool can_run(std::size_t task) const {
    return oracle_.can_run(task, oracle_.all(facts_.group_of[task]));
  }

  bool both_run(std::size_t a, std::size_t b, ConstraintSet in_force) const {
    const std::size_t group = facts_.group_of[a];
    return facts_.group_of[b] != group || oracle_.any(group, in_force, [&](const Row& row) {
      return row.values[a] != none && row.values[b] != none;
    });
  }

  /// Of tasks that can run.
  Together together(std::size_t a, std::size_t b) const {
    if (facts_.excludes[a].contains(b)) return Together::excluded;
    return both_run(a, b, oracle_.all(facts_.group_of[a])) ? Together::possible
                                                           : Together::excluded_indirectly;
  }

  void check_pair(const TaskPair& pair, std::size_t a, std::size_t b) const {
    const std::string names = name_of(a) + " and " + name_of(b);
    demand(in_model(pair.first) == a && in_model(pair.second) == b, "another order: " + names);
    const Together expected = together(a, b);
    demand(pair.together == expected, "wrong about " + names);
    statistics_.count(std::string(cbc::name_of(expected)));
    if (expected == Together::possible) {
      demand(pair.reasons.empty(), "reasons for nothing: " + names);
      return;
    }
    const ConstraintSet reasons = set_of(pair.reasons, facts_.group_of[a]);
    demand(!both_run(a, b, reasons), "the reasons are not enough: " + names);
    for (ConstraintSet rest = reasons; rest != 0; rest &= rest - 1) {
      demand(both_run(a, b, reasons & ~(rest & ~(rest - 1))), "a superfluous reason: " + names);
    }
    if (pair.reasons.size() > 3) statistics_.count("more than three reasons");
  }

  ConstraintSet set_of(const std::vector<Reason>& reasons, std::size_t group) const {
    ConstraintSet set = 0;
    for (const Reason& reason : reasons) set |= set_of(reason, group);
    return set;
  }

  ConstraintSet set_of(const Reason& reason, std::size_t group) const {
    const std::size_t task = in_model(reason.task);
    const std::size_t behavior =
        reason.behavior == cbc::none
            ? none
            : behaviors_[compiled_.behaviors[reason.behavior].catalog_index];
    const ConstraintSet found = oracle_.those(group, [&](const Constraint& one) {
      if (reason.kind == Reason::Kind::exclusive) {
        const std::size_t other = in_model(reason.other_task);
        return one.kind == Constraint::Kind::exclusive &&
               std::minmax(one.task, one.other_task) == std::minmax(task, other);
      }
      const Constraint::Kind kind = reason.kind == Reason::Kind::requires_task
                                        ? Constraint::Kind::requires_task
                                        : Constraint::Kind::performance;
      return one.kind == kind && one.task == task && one.behavior == behavior;
    });
    demand(found != 0, "a reason that is no constraint");
    return found;
  }

  /// By task, in catalog order: how the message begins, or nothing.
  using Messages = std::vector<std::pair<std::size_t, std::string>>;

  Messages never_started() const {
    Messages messages;
    bool has_other_starts = false;
    for (const std::size_t task : tasks_) {
      const Task& one = catalog_.tasks[task];
      has_other_starts = has_other_starts || one.start_on_request || one.reactive_start;
      const bool is_required = std::any_of(
          catalog_.behaviors.begin(), catalog_.behaviors.end(), [task](const Behavior& behavior) {
            return std::any_of(behavior.requirements.begin(), behavior.requirements.end(),
                               [task](const auto& required) { return required.task == task; });
          });
      if (one.start_on_request || one.reactive_start || is_required) continue;
      if (facts_.behaviors_of[task].empty()) continue;
      messages.emplace_back(task, "task " + name_of(task) + " never starts without a request: ");
    }
    if (!has_other_starts && messages.size() > 1) messages.resize(1);
    return messages;
  }

  Messages blocked_reactive() const {
    Messages messages;
    for (const std::size_t task : tasks_) {
      if (!catalog_.tasks[task].reactive_start || !can_run(task)) continue;
      std::vector<std::size_t> others;
      for (const std::size_t other : tasks_) {
        if (catalog_.tasks[other].start_on_request && can_run(other) &&
            together(task, other) == Together::excluded_indirectly) {
          others.push_back(other);
        }
      }
      if (others.empty()) continue;
      std::string message =
          "reactive task " + name_of(task) + " cannot run beside " + name_of(others.front());
      if (others.size() == 1) message += ", though";
      messages.emplace_back(task, std::move(message));
    }
    return messages;
  }

  void check_rule(const std::vector<Diagnostic>& findings, const std::string& rule,
                  const Messages& expected) const {
    std::vector<std::string> messages;
    for (const Diagnostic& finding : findings) {
      if (finding.rule == rule) messages.push_back(finding.message);
    }
    demand(messages.size() == expected.size(), "another number of findings of " + rule);
    for (const auto& entry : expected) {
      const std::string& begin = entry.second;
      demand(std::any_of(messages.begin(), messages.end(),
                         [&begin](const auto& one) { return one.starts_with(begin); }),
             rule + " does not say: " + begin);
      statistics_.count(rule);
    }
  }

  const LintOracle& oracle_;
  const CatalogFacts& facts_;
  const Catalog& catalog_;
  const CompiledCatalog& compiled_;
  Statistics& statistics_;
  std::vector<std::size_t> tasks_;      ///< of the model, by place in the catalog
  std::vector<std::size_t> behaviors_;  ///< the same
};

void run_case(std::uint64_t seed, Results& results) {
  Random random(seed);
  Catalog catalog = generate_strict_catalog(random);
  for (Task& task : catalog.tasks) {
    if (task.listed && !task.start_on_request) task.reactive_start = random.percent(30);
  }
  const std::string yaml = catalog_yaml(catalog, random);
  try {
    const CatalogFacts facts(catalog);
    const LintOracle oracle(facts);
    Diagnostics diagnostics;
    const auto document = yaml::parse(yaml, "catalog.yaml", diagnostics);
    demand(document != nullptr, "no YAML");
    const CheckedCatalog linted = lint_catalog(*document, {}, diagnostics);
    demand(linted.compiled != nullptr, "not understood");
    const Check check(oracle, *linted.compiled, results.statistics);
    check.check_table(make_together_table(*linted.compiled, {}));
    check.check_findings(diagnostics.all());
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" + yaml +
                                        "--- fault\n" + error.what() + "\n"});
  }
}

const LowerBound lower_bounds[] = {
    {"possible", 300},           {"excluded", 100},
    {"excluded_indirectly", 50}, {"more than three reasons", 10},
    {"never-started", 100},      {"blocked-reactive", 20},
    {"of all tasks", 5},
};

TEST(Together, IsWhatBruteForceFinds) { run_random_cases(default_cases, run_case, lower_bounds); }

}  // namespace
}  // namespace cbc::oracle::together_property_test
