#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

#include "core/script/expectation.h"

namespace cbc {
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
    if (!expected.behavior) {
      demand({Demand::Kind::run, task, none});
      if (!state_.is_running(task)) note_mismatch(task);
      return;
    }
    const BehaviorId behavior = catalog_.behavior_ids[*expected.behavior];
    const auto values = catalog_.values[task];
    const auto value = std::find_if(values.begin(), values.end(), [behavior](const Value& one) {
      return one.behavior == behavior;
    });
    if (value == values.end()) {
      group_of(task).is_impossible = true;
      return;
    }
    demand({Demand::Kind::has, task, static_cast<std::uint32_t>(value - values.begin())});
    if (state_.behavior(task) != behavior) note_mismatch(task);
  }

  void add_active(const std::vector<std::uint32_t>& behaviors) {
    std::vector<std::uint8_t> is_expected(catalog_.behaviors.size(), 0);
    for (const std::uint32_t index : behaviors) is_expected[catalog_.behavior_ids[index]] = 1;
    for (BehaviorId behavior = 0; behavior < is_expected.size(); ++behavior) {
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
    Group& group = groups_[catalog_.group_of(behavior)];
    if (group.ways.size() * performed.size() > most_ways) {
      group.is_impossible = true;
      return;
    }
    std::vector<Demands> ways;
    for (const Demands& way : group.ways) {
      for (const ValueId value : performed) {
        ways.push_back(way);
        ways.back().push_back(demand_of(Demand::Kind::has, value));
      }
    }
    group.ways = std::move(ways);
    if (state_.is_active(behavior)) return;
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
  std::map<std::uint32_t, Group> groups_;
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
