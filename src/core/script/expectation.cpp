#include "core/script/expectation.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string_view>
#include <utility>

#include "core/diagnostic/rules.h"
#include "core/script/contradictions.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {

namespace {

using yaml::Kind;
using yaml::Node;

class ExpectationReader {
 public:
  ExpectationReader(NameIndex& names, Reporter& reporter) : names_(names), reporter_(reporter) {}

  Expectation read(const Node& node) && {
    if (yaml::read_mapping(node, "expect", "a mapping", reporter_) == nullptr) return {};
    const std::size_t errors = reporter_.errors();
    yaml::Fields fields(node, shape::expectation, reporter_);
    if (const Node* outcome = fields.find("outcome")) {
      out_.outcome = read_word<Outcome>(*outcome, "outcome", reporter_);
    }
    if (const Node* entries = fields.find("running")) {
      read_running(*entries, names_, reporter_, said_.parts);
      for (const StateCondition& entry : said_.parts) add_running(entry);
    }
    if (const Node* stopped = fields.find("stopped")) read_stopped(*stopped);
    if (const Node* active = fields.find("active")) {
      StateCondition only{StateCondition::Kind::only_active};
      only.range = fields.range_of("active");
      out_.active = read_active(*active, "active", only.parts);
      said_.parts.push_back(std::move(only));
    }
    if (const Node* active = fields.find("active_includes")) {
      out_.active_includes = read_active(*active, "active_includes", said_.parts);
    }
    check_active_keys(fields, reporter_);
    if (const Node* tasks = fields.find("suspended")) out_.suspended = read_suspended(*tasks);
    if (const Node* behaviors = fields.find("failed")) out_.failed = read_failed(*behaviors);
    fields.report_unknown(yaml::UnknownKeys::refused);
    if (reporter_.errors() == errors) check();
    return std::move(out_);
  }

 private:
  /// The script has a meaning even so.
  static constexpr Standing of_impossible{Severity::warning};

  void add_running(const StateCondition& entry) {
    const CompiledCatalog& catalog = names_.catalog();
    auto& running = out_.running.emplace_back();
    running.task = catalog.tasks[entry.task].catalog_index;
    for (const BehaviorId behavior : entry.behaviors) {
      running.behaviors.push_back(catalog.behaviors[behavior].catalog_index);
    }
  }

  void read_stopped(const Node& node) {
    if (yaml::read_list(node, "stopped", "a list of tasks", reporter_) == nullptr) return;
    for (const Node* item : node.items) {
      const auto task = names_.find_task(*item, "stopped", reporter_, &node);
      if (!task) continue;
      out_.stopped.push_back(*task);
      said_.parts.push_back(
          StateCondition::of_task(StateCondition::Kind::stopped, names_.catalog().task_ids[*task]));
      said_.parts.back().range = item->range;
    }
  }

  std::vector<std::uint32_t> read_active(const Node& node, std::string_view key,
                                         std::vector<StateCondition>& conditions) {
    std::vector<std::uint32_t> behaviors;
    if (yaml::read_list(node, key, "a list of behaviors", reporter_) == nullptr) return behaviors;
    for (const Node* item : node.items) {
      const auto behavior = names_.find_behavior(*item, key, reporter_, &node);
      if (!behavior) continue;
      behaviors.push_back(*behavior);
      conditions.push_back(StateCondition::of_behavior(StateCondition::Kind::active,
                                                       names_.catalog().behavior_ids[*behavior]));
      conditions.back().range = item->range;
    }
    return behaviors;
  }

  std::vector<std::uint32_t> read_suspended(const Node& node) {
    std::vector<std::uint32_t> tasks;
    if (yaml::read_list(node, "suspended", "a list of tasks", reporter_) == nullptr) return tasks;
    const CompiledCatalog& catalog = names_.catalog();
    for (const Node* item : node.items) {
      const auto task = names_.find_task(*item, "suspended", reporter_, &node);
      if (!task) continue;
      tasks.push_back(*task);
      if (catalog.rules_of(catalog.task_ids[*task]).resume != 0) continue;
      report_impossible(item->range, concat("task ", quote(catalog.task_names[*task]),
                                            " does not resume, so its request never waits"));
    }
    return tasks;
  }

  std::vector<std::uint32_t> read_failed(const Node& node) {
    std::vector<std::uint32_t> behaviors;
    if (yaml::read_list(node, "failed", "a list of behaviors", reporter_) == nullptr) {
      return behaviors;
    }
    const CompiledCatalog& catalog = names_.catalog();
    for (const Node* item : node.items) {
      const auto behavior = names_.find_behavior(*item, "failed", reporter_, &node);
      if (!behavior) continue;
      behaviors.push_back(*behavior);
      if (catalog.retry_of(catalog.behavior_ids[*behavior]) != Retry::at_events) continue;
      report_impossible(item->range,
                        concat("behavior ", quote(catalog.behavior_names[*behavior]),
                               " is tried again at any event (its 'retry' is at_events)"));
    }
    return behaviors;
  }

  void report_impossible(const Range& range, const std::string& why) {
    reporter_.report_as(of_impossible, rule::impossible_expectation, range,
                        "this can never hold: " + why);
  }

  void check() {
    const Contradictions contradictions(names_.catalog());
    Contradictions::Parts parts;
    contradictions.add(said_, parts);
    if (parts.empty()) return;
    report(contradictions.take_misplaced(parts, Ground::catalog));
    report(contradictions.find(parts, Ground::catalog, names_.states(), reporter_));
  }

  void report(const std::vector<Impossible>& findings) {
    for (const Impossible& finding : findings) {
      reporter_.report_as(of_impossible, rule::impossible_expectation, finding.range,
                          "this can never hold: " + finding.text(), finding.notes);
    }
  }

  NameIndex& names_;
  Reporter& reporter_;
  Expectation out_;
  StateCondition said_;
};

}  // namespace

Expectation read_expectation(const Node& node, NameIndex& names, Reporter& reporter) {
  return ExpectationReader(names, reporter).read(node);
}

namespace {

/// Reads a behavior, or several of them, into a condition. False if there is none.
bool read_performers(const Node& node, std::string_view task, NameIndex& names, Reporter& reporter,
                     StateCondition& condition) {
  const std::vector<const Node*> single{&node};
  const bool is_list = node.kind == Kind::sequence;
  if (node.kind != Kind::scalar && (!is_list || node.items.empty())) {
    yaml::report_wrong_type(node, task, "a behavior, a list of behaviors or 'any'", reporter);
    return false;
  }
  ListedNames listed;
  for (const Node* item : is_list ? node.items : single) {
    if (is_list && item->kind == Kind::scalar && item->text == "any") {
      reporter.report(rule::invalid_value, item->range,
                      "'any' stands in place of a list, not in it");
      continue;
    }
    const auto behavior = names.find_behavior(*item, task, reporter, is_list ? &node : nullptr);
    if (!behavior || !listed.add(*behavior, *item, reporter)) continue;
    condition.behaviors.push_back(names.catalog().behavior_ids[*behavior]);
    condition.behavior_ranges.push_back(item->range);
  }
  return !condition.behaviors.empty();
}

}  // namespace

void read_running(const Node& node, NameIndex& names, Reporter& reporter,
                  std::vector<StateCondition>& conditions) {
  constexpr std::string_view expected = "a mapping of tasks to behaviors or 'any'";
  if (yaml::read_mapping(node, "running", expected, reporter) == nullptr) return;
  yaml::report_duplicate_keys(node, reporter);
  for (const auto& [key, value] : node.entries) {
    const auto task = names.find_task(*key, "running", reporter, &node);
    StateCondition condition{StateCondition::Kind::running};
    condition.range = key->range;
    const bool is_any = value->kind == Kind::scalar && value->text == "any";
    if (!is_any && !read_performers(*value, key->text, names, reporter, condition)) continue;
    if (!task) continue;
    condition.task = names.catalog().task_ids[*task];
    conditions.push_back(std::move(condition));
  }
}

void check_active_keys(const yaml::Fields& fields, Reporter& reporter) {
  if (!fields.has("active") || !fields.has("active_includes")) return;
  reporter.report(rule::invalid_value, fields.range_of("active_includes"),
                  "'active' lists all behaviors that are active: leave out 'active_includes', or "
                  "'active'",
                  {reporter.note(fields.range_of("active"), "all active behaviors are here")});
}

namespace {

/// Each way takes a search.
constexpr std::size_t most_ways = 64;

/// Whether two demands on the same task contradict each other. Asked for both orders.
bool exclude(const Demand& one, const Demand& other) {
  if (one.kind == Demand::Kind::stop) {
    return other.kind == Demand::Kind::run || other.kind == Demand::Kind::has;
  }
  if (one.kind != Demand::Kind::has) return false;
  if (other.kind == Demand::Kind::has) return one.value_index != other.value_index;
  return other.kind == Demand::Kind::has_not && one.value_index == other.value_index;
}

class ExpectedGroups {
 public:
  ExpectedGroups(const CompiledCatalog& catalog, const State& state)
      : catalog_(catalog), state_(state) {}

  void add(const Expectation& expectation) {
    for (const Expectation::Running& expected : expectation.running) add_running(expected);
    for (const std::uint32_t index : expectation.stopped) {
      const TaskId task = catalog_.task_ids[index];
      demand({Demand::Kind::stop, task, none});
      if (state_.is_running(task)) note_mismatch(task);
    }
    if (expectation.active) add_active(*expectation.active);
    for (const std::uint32_t index : expectation.active_includes) {
      add_active_behavior(catalog_.behavior_ids[index]);
    }
  }

  std::vector<ExpectedValues> take() {
    std::vector<ExpectedValues> result;
    for (auto& [group, expected] : groups_) {
      if (expected.tasks.empty() || expected.is_impossible || is_contradictory(expected.ways)) {
        continue;
      }
      ExpectedValues& values = result.emplace_back();
      values.group = group;
      for (const auto& [index, task] : expected.tasks) values.tasks.push_back(task);
      values.ways = std::move(expected.ways);
    }
    return result;
  }

 private:
  struct Group {
    std::map<std::uint32_t, TaskId> tasks;  ///< that are not as expected, by catalog index
    std::vector<Demands> ways{Demands()};
    bool is_impossible = false;
  };

  Group& group_of(TaskId task) { return groups_[catalog_.tasks[task].group]; }

  void note_mismatch(TaskId task) {
    group_of(task).tasks.emplace(catalog_.tasks[task].catalog_index, task);
  }

  void demand(const Demand& demand) {
    for (Demands& way : group_of(demand.task).ways) way.push_back(demand);
  }

  void add_running(const Expectation::Running& expected) {
    const TaskId task = catalog_.task_ids[expected.task];
    if (expected.behaviors.empty()) {
      demand({Demand::Kind::run, task, none});
      if (!state_.is_running(task)) note_mismatch(task);
      return;
    }
    std::vector<Demand> demands;
    bool holds = false;
    const auto values = catalog_.values[task];
    for (const std::uint32_t index : expected.behaviors) {
      const BehaviorId behavior = catalog_.behavior_ids[index];
      const auto value = std::find_if(values.begin(), values.end(), [behavior](const Value& one) {
        return one.behavior == behavior;
      });
      if (value == values.end()) continue;
      demands.push_back(
          {Demand::Kind::has, task, static_cast<std::uint32_t>(value - values.begin())});
      holds |= state_.behavior(task) == behavior;
    }
    demand_one_of(demands, group_of(task));
    if (!holds) note_mismatch(task);
  }

  /// Without any, the expectation can never hold.
  static void demand_one_of(const std::vector<Demand>& demands, Group& group) {
    if (demands.empty() || group.ways.size() * demands.size() > most_ways) {
      group.is_impossible = true;
      return;
    }
    std::vector<Demands> ways;
    for (const Demands& way : group.ways) {
      for (const Demand& demand : demands) {
        ways.push_back(way);
        ways.back().push_back(demand);
      }
    }
    group.ways = std::move(ways);
  }

  void add_active(const std::vector<std::uint32_t>& behaviors) {
    std::vector<std::uint8_t> is_expected(catalog_.behaviors.size(), 0);
    for (const std::uint32_t index : behaviors) is_expected[catalog_.behavior_ids[index]] = 1;
    for (BehaviorId behavior(0); behavior < is_expected.size(); ++behavior) {
      if (is_expected[behavior] != 0) {
        add_active_behavior(behavior);
      } else {
        add_inactive_behavior(behavior);
      }
    }
  }

  [[nodiscard]] Demand demand_of(Demand::Kind kind, ValueId value) const {
    const TaskId task = catalog_.task_of(value);
    return {kind, task, value - catalog_.values.begin[task]};
  }

  void add_inactive_behavior(BehaviorId behavior) {
    for (const ValueId value : catalog_.performs[behavior]) {
      const TaskId task = catalog_.task_of(value);
      demand(demand_of(Demand::Kind::has_not, value));
      if (state_.behavior(task) == behavior) note_mismatch(task);
    }
  }

  void add_active_behavior(BehaviorId behavior) {
    const auto performed = catalog_.performs[behavior];
    std::vector<Demand> demands;
    for (const ValueId value : performed) demands.push_back(demand_of(Demand::Kind::has, value));
    Group& group = groups_[catalog_.group_of(behavior)];
    demand_one_of(demands, group);
    if (group.is_impossible || state_.is_active(behavior)) return;
    for (const ValueId value : performed) note_mismatch(catalog_.task_of(value));
  }

  static bool is_contradictory(const std::vector<Demands>& ways) {
    return std::all_of(ways.begin(), ways.end(), [](const Demands& way) {
      return std::any_of(way.begin(), way.end(), [&way](const Demand& one) {
        return std::any_of(way.begin(), way.end(), [&one](const Demand& other) {
          return one.task == other.task && exclude(one, other);
        });
      });
    });
  }

  const CompiledCatalog& catalog_;
  const State& state_;
  std::map<GroupId, Group> groups_;
};

}  // namespace

std::vector<ExpectedValues> find_expected_values(const Expectation& expectation,
                                                 const CompiledCatalog& catalog,
                                                 const State& state) {
  ExpectedGroups groups(catalog, state);
  groups.add(expectation);
  return groups.take();
}

}  // namespace cbc
