// Random small catalogs with situation variables: whether two tasks can run together, why not, and
// what can never run, compared with an enumeration of all situations and assignments.
// CBC_SEED and CBC_PROPERTY_CASES are as in lint_property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ask/together.h"
#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "demand.h"
#include "random.h"
#include "random_cases.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::oracle::situations_together_test {
namespace {

constexpr std::uint64_t default_cases = 1000;
constexpr std::size_t task_count = 5;
/// Numbers of values of the variables V0 and V1.
constexpr std::size_t value_counts[] = {3, 2};

/// A behavior performs one task.
struct Performer {
  std::size_t task = 0;
};

struct Rule {
  enum class Kind : std::uint8_t { exclusive, requires_task, condition };
  Kind kind = Kind::exclusive;
  std::size_t first = 0;            ///< a task; of the other kinds a behavior
  std::size_t second = 0;           ///< a task; of a condition a variable
  std::vector<std::size_t> values;  ///< of a condition: in which the behavior fits
};

struct Model {
  std::vector<Performer> behaviors;
  std::vector<Rule> rules;
};

Model generate(Random& random) {
  Model model;
  for (std::size_t task = 0; task < task_count; ++task) {
    const std::size_t count = 1 + random.below(2);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t behavior = model.behaviors.size();
      model.behaviors.push_back({task});
      for (std::size_t other = task + 1; other < task_count; ++other) {
        if (!random.percent(25)) continue;
        model.rules.push_back({Rule::Kind::requires_task, behavior, other, {}});
      }
      for (std::size_t variable = 0; variable < 2; ++variable) {
        if (!random.percent(40)) continue;
        const std::size_t left_out = random.below(value_counts[variable]);
        std::vector<std::size_t> values;
        for (std::size_t value = 0; value < value_counts[variable]; ++value) {
          const bool stays = value != left_out && (values.empty() || random.percent(50));
          if (stays) values.push_back(value);
        }
        model.rules.push_back({Rule::Kind::condition, behavior, variable, values});
      }
    }
  }
  for (std::size_t a = 0; a < task_count; ++a) {
    for (std::size_t b = a + 1; b < task_count; ++b) {
      if (random.percent(15)) model.rules.push_back({Rule::Kind::exclusive, a, b, {}});
    }
  }
  return model;
}

std::string yaml_of(const Model& model) {
  std::string text =
      "situation:\n- {variable: V0, values: [a, b, c]}\n- {variable: V1, values: [a, b]}\n"
      "behaviors:\n";
  for (std::size_t behavior = 0; behavior < model.behaviors.size(); ++behavior) {
    std::string required;
    std::string situation;
    for (const Rule& rule : model.rules) {
      if (rule.kind == Rule::Kind::exclusive || rule.first != behavior) continue;
      if (rule.kind == Rule::Kind::requires_task) {
        required += "{task: T" + std::to_string(rule.second) + "}, ";
        continue;
      }
      situation += "V" + std::to_string(rule.second) + ": [";
      for (const std::size_t value : rule.values) situation += std::string(1, "abc"[value]) + ", ";
      situation += "], ";
    }
    text += "- {behavior: B" + std::to_string(behavior) + ", task: T" +
            std::to_string(model.behaviors[behavior].task) + ", requires: [" + required +
            "], situation: {" + situation + "}}\n";
  }
  text += "tasks:\n";
  for (std::size_t task = 0; task < task_count; ++task) {
    text += "- {task: T" + std::to_string(task) + ", execution_goal: keep_running}\n";
  }
  text += "exclusivity_constraints:\n";
  for (const Rule& rule : model.rules) {
    if (rule.kind != Rule::Kind::exclusive) continue;
    text += "- mutually_exclusive: [T" + std::to_string(rule.first) + ", T" +
            std::to_string(rule.second) + "]\n";
  }
  return text;
}

using InForce = std::vector<bool>;  ///< by rule

/// Tries all assignments in all situations.
class Enumeration {
 public:
  explicit Enumeration(const Model& model) : model_(model), performers_(task_count) {
    for (std::size_t behavior = 0; behavior < model.behaviors.size(); ++behavior) {
      performers_[model.behaviors[behavior].task].push_back(behavior);
    }
  }

  /// Whether some tasks run together, perhaps one of them with a certain behavior.
  [[nodiscard]] bool run(const std::vector<std::size_t>& tasks, const InForce& in_force,
                         std::optional<std::size_t> behavior = std::nullopt) const {
    for (std::size_t situation = 0; situation < 6; ++situation) {
      if (run_in(situation, tasks, in_force, behavior)) return true;
    }
    return false;
  }

  /// The same in one situation.
  [[nodiscard]] bool run_in(std::size_t situation, const std::vector<std::size_t>& tasks,
                            const InForce& in_force,
                            std::optional<std::size_t> behavior = std::nullopt) const {
    std::vector<std::size_t> place(task_count, 0);  // 0: does not run
    for (;;) {
      if (holds(situation, place, tasks, in_force, behavior)) return true;
      std::size_t task = 0;
      while (task < task_count && ++place[task] > performers_[task].size()) place[task++] = 0;
      if (task == task_count) return false;
    }
  }

 private:
  [[nodiscard]] bool holds(std::size_t situation, const std::vector<std::size_t>& place,
                           const std::vector<std::size_t>& tasks, const InForce& in_force,
                           std::optional<std::size_t> wanted) const {
    const auto is_active = [&](std::size_t behavior) {
      const std::size_t task = model_.behaviors[behavior].task;
      return place[task] != 0 && performers_[task][place[task] - 1] == behavior;
    };
    for (const std::size_t task : tasks) {
      if (place[task] == 0) return false;
    }
    if (wanted && !is_active(*wanted)) return false;
    for (std::size_t i = 0; i < model_.rules.size(); ++i) {
      const Rule& rule = model_.rules[i];
      if (!in_force[i]) continue;
      if (rule.kind == Rule::Kind::exclusive) {
        if (place[rule.first] != 0 && place[rule.second] != 0) return false;
        continue;
      }
      if (!is_active(rule.first)) continue;
      if (rule.kind == Rule::Kind::requires_task) {
        if (place[rule.second] == 0) return false;
        continue;
      }
      const std::size_t value = rule.second == 0 ? situation % 3 : situation / 3;
      if (!contains(rule.values, value)) return false;
    }
    return true;
  }

  const Model& model_;
  std::vector<std::vector<std::size_t>> performers_;  ///< by task
};

class Check {
 public:
  Check(const Model& model, const CompiledCatalog& catalog, Statistics& statistics)
      : model_(model),
        catalog_(catalog),
        statistics_(statistics),
        enumeration_(model),
        all_(model.rules.size(), true),
        constraints_(model.rules.size()) {
    for (std::size_t i = 0; i < model.rules.size(); ++i) {
      constraints_[i] = model.rules[i].kind != Rule::Kind::condition;
    }
  }

  void check_table(const TogetherTable& table) const {
    std::size_t able = 0;
    for (std::size_t task = 0; task < task_count; ++task) {
      const bool can_run = enumeration_.run({task}, all_);
      const std::vector<TaskId>& list = can_run ? table.tasks : table.never_run;
      demand(std::any_of(list.begin(), list.end(),
                         [&](TaskId id) { return catalog_.tasks[id].catalog_index == task; }),
             "wrong about whether T" + std::to_string(task) + " can run");
      able += can_run ? 1 : 0;
      if (!can_run && enumeration_.run({task}, constraints_)) {
        statistics_.count("fits in no situation");
      }
    }
    demand(table.pairs.size() == able * (able - 1) / 2 || able == 0, "other pairs");
    for (const TaskPair& pair : table.pairs) check_pair(pair);
  }

  /// What is said to be dead is dead, and if something is, there is a finding.
  void check_findings(const std::vector<Diagnostic>& findings) const {
    bool has_dead = false;
    bool has_finding = false;
    for (std::size_t behavior = 0; behavior < model_.behaviors.size(); ++behavior) {
      has_dead |= !enumeration_.run({}, all_, behavior);
    }
    for (const Diagnostic& finding : findings) {
      has_finding |=
          finding.rule == "exclusive-requirement" || finding.rule == "conflicting-requirements";
      if (!finding.rule.starts_with("dead-")) continue;
      has_finding = true;
      const std::size_t begin = finding.message.find('\'') + 2;
      const std::size_t number = std::stoul(finding.message.substr(begin));
      const bool can_run = finding.rule == "dead-task" ? enumeration_.run({number}, all_)
                                                       : enumeration_.run({}, all_, number);
      demand(!can_run, "not dead: " + finding.message);
      demand(!finding.notes.empty(), "no reasons: " + finding.message);
    }
    demand(has_dead == has_finding, "wrong about whether something is dead");
  }

 private:
  [[nodiscard]] Together expected(std::size_t a, std::size_t b) const {
    for (const Rule& rule : model_.rules) {
      if (rule.kind == Rule::Kind::exclusive && rule.first == a && rule.second == b) {
        return Together::excluded;
      }
    }
    if (enumeration_.run({a, b}, all_)) return Together::possible;
    if (!enumeration_.run({a, b}, constraints_)) return Together::excluded_indirectly;
    for (std::size_t situation = 0; situation < 6; ++situation) {
      if (enumeration_.run_in(situation, {a}, all_) && enumeration_.run_in(situation, {b}, all_)) {
        return Together::excluded_in_each_situation;
      }
    }
    return Together::excluded_by_situation;
  }

  void check_pair(const TaskPair& pair) const {
    const std::size_t a = catalog_.tasks[pair.first].catalog_index;
    const std::size_t b = catalog_.tasks[pair.second].catalog_index;
    const std::string names = "T" + std::to_string(a) + " and T" + std::to_string(b);
    demand(pair.together == expected(a, b), "wrong about " + names);
    statistics_.count(std::string(cbc::name_of(pair.together)));
    if (pair.together == Together::possible) return;
    InForce reasons(model_.rules.size(), false);
    for (const Reason& reason : pair.reasons) reasons[rule_of(reason)] = true;
    demand(!enumeration_.run({a, b}, reasons), "the reasons are not enough: " + names);
    for (std::size_t i = 0; i < reasons.size(); ++i) {
      if (!reasons[i]) continue;
      InForce rest = reasons;
      rest[i] = false;
      demand(enumeration_.run({a, b}, rest), "a superfluous reason: " + names);
    }
  }

  [[nodiscard]] std::size_t rule_of(const Reason& reason) const {
    const auto task = [this](TaskId id) { return std::size_t{catalog_.tasks[id].catalog_index}; };
    for (std::size_t i = 0; i < model_.rules.size(); ++i) {
      const Rule& rule = model_.rules[i];
      if (reason.kind == Reason::Kind::exclusive) {
        if (rule.kind != Rule::Kind::exclusive) continue;
        const auto pair = std::minmax({task(reason.task), task(reason.other_task)});
        if (rule.first == pair.first && rule.second == pair.second) return i;
        continue;
      }
      const bool is_condition = reason.kind == Reason::Kind::situation;
      if (rule.kind != (is_condition ? Rule::Kind::condition : Rule::Kind::requires_task)) continue;
      if (rule.first != catalog_.behaviors[reason.behavior].catalog_index) continue;
      if (rule.second == (is_condition ? reason.variable : task(reason.task))) return i;
    }
    demand(false, "a reason that is not in the catalog");
    return 0;
  }

  const Model& model_;
  const CompiledCatalog& catalog_;
  Statistics& statistics_;
  const Enumeration enumeration_;
  const InForce all_;
  InForce constraints_;  ///< without conditions
};

void run_case(std::uint64_t seed, Results& results) {
  Random random(seed);
  const Model model = generate(random);
  const std::string yaml = yaml_of(model);
  try {
    Diagnostics diagnostics;
    const auto document = yaml::parse(yaml, "catalog.yaml", diagnostics);
    demand(document != nullptr, "no YAML");
    const CheckedCatalog linted = lint_catalog(*document, {}, diagnostics);
    demand(linted.compiled != nullptr, "not understood");
    const Check check(model, *linted.compiled, results.statistics);
    check.check_table(make_together_table(*linted.compiled, {}));
    check.check_findings(diagnostics.all());
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" + yaml +
                                        "--- fault\n" + error.what() + "\n"});
  }
}

const LowerBound lower_bounds[] = {
    {"possible", 1000},
    {"excluded", 300},
    {"excluded_indirectly", 50},
    {"excluded_in_each_situation", 5},
    {"excluded_by_situation", 100},
    {"fits in no situation", 20},
};

TEST(SituationsTogether, AreWhatAnEnumerationFinds) {
  run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::oracle::situations_together_test
