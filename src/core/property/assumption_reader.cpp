#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/property/property_reader.h"
#include "core/script/names.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

/// Reads what may happen. Lists are brought into catalog order.
class AssumptionReader {
 public:
  AssumptionReader(NameIndex& names, Reporter& reporter)
      : names_(names), catalog_(names.catalog()), reporter_(reporter) {}

  Assumptions read(const Node* assume, const Node* initially, bool knows_all) && {
    out_ = default_assumptions(catalog_);
    knows_first_ = knows_all;
    if (initially != nullptr) read_initially(*initially);
    if (assume != nullptr &&
        yaml::read_mapping(*assume, "assume", "a mapping", reporter_) != nullptr) {
      read_assume(*assume);
    }
    return std::move(out_);
  }

 private:
  void read_initially(const Node& node) {
    const auto situation = read_situation(node, names_, reporter_);
    if (situation) out_.initially = part_of(*situation, catalog_);
    knows_first_ &= situation.has_value();
  }

  void read_assume(const Node& node) {
    Fields fields(node, shape::assumptions, reporter_);
    if (const Node* start = fields.find("start")) read_start(*start);
    if (const Node* stop = fields.find("stop")) read_stop(*stop);
    read_flag(fields, "successes", out_.successes);
    read_flag(fields, "failures", out_.failures);
    if (const Node* faults = fields.find("faults")) read_faults(*faults);
    if (const Node* situation = fields.find("situation")) read_changing(*situation);
    if (const Node* never = fields.find("never")) read_never(*never);
    fields.report_unknown(yaml::UnknownKeys::refused);
  }

  void read_faults(const Node& node) {
    if (node.kind == Kind::scalar) return read_most(node, "faults");
    constexpr std::string_view expected = "a number of behaviors, or a mapping with 'most'";
    if (node.kind != Kind::mapping) {
      return yaml::report_wrong_type(node, "faults", expected, reporter_);
    }
    Fields fields(node, shape::faults, reporter_);
    if (const Node* most = fields.find("most")) {
      read_most(*most, "most");
    } else if (!fields.has_unknown()) {
      reporter_.report(rule::missing_key, node.range,
                       "'faults' needs 'most': how many behaviors may be faulty at a time");
    }
    const Node* const of = fields.find("of");
    const Node* const except = fields.find("except");
    if (of != nullptr && except != nullptr) {
      reporter_.report(rule::invalid_value, fields.range_of("except"),
                       "'faults' takes 'of' or 'except', not both",
                       {reporter_.note(fields.range_of("of"), "'of' is here")});
    } else if (of != nullptr) {
      read_fallible(*of, "of", true);
    } else if (except != nullptr) {
      read_fallible(*except, "except", false);
    }
    fields.report_unknown(yaml::UnknownKeys::refused);
  }

  void read_most(const Node& node, std::string_view what) {
    const auto most = yaml::read_integer(node, what, 0, reporter_);
    if (most) out_.faults = static_cast<std::uint32_t>(*most);
  }

  /// The behaviors that can become faulty, or all others can.
  void read_fallible(const Node& node, std::string_view what, bool only_these) {
    if (yaml::read_list(node, what, "a list of behaviors", reporter_) == nullptr) return;
    if (node.items.empty()) {
      reporter_.report(
          rule::invalid_value, node.range,
          concat("expected at least one behavior in ", quote(what), ", found an empty list"));
    }
    out_.only_listed_fail = only_these;
    out_.listed_for_faults.clear();
    ListedNames listed;
    for (const Node* item : node.items) {
      const auto behavior = names_.find_behavior(*item, what, reporter_, &node);
      if (behavior && listed.add(*behavior, *item, reporter_)) {
        out_.listed_for_faults.push_back(catalog_.behavior_ids[*behavior]);
      }
    }
    sort_behaviors(out_.listed_for_faults);
  }

  void sort_behaviors(std::vector<BehaviorId>& behaviors) const {
    std::sort(behaviors.begin(), behaviors.end(), [this](BehaviorId a, BehaviorId b) {
      return catalog_.behaviors[a].catalog_index < catalog_.behaviors[b].catalog_index;
    });
  }

  void read_flag(const Fields& fields, std::string_view key, bool& flag) {
    if (const Node* node = fields.find(key)) {
      flag = yaml::read_boolean(*node, key, reporter_).value_or(flag);
    }
  }

  void read_start(const Node& node) {
    out_.start.clear();
    if (node.kind == Kind::mapping) {
      yaml::report_duplicate_keys(node, reporter_);
      for (const auto& [key, value] : node.entries) {
        const auto task = names_.find_task(*key, "start", reporter_, &node);
        std::vector<std::int32_t> priorities = read_priorities(key->text, *value);
        if (task) out_.start.push_back({catalog_.task_ids[*task], std::move(priorities)});
      }
    } else if (node.kind == Kind::sequence) {
      for (const TaskId task : read_tasks(node, "start")) out_.start.push_back({task, {1}});
    } else if (node.text == "all") {
      for (const TaskId task : catalog_.task_ids) out_.start.push_back({task, {1}});
    } else {
      yaml::report_wrong_type(
          node, "start", "a list of tasks, a mapping of tasks to lists of priorities, or 'all'",
          reporter_);
    }
    std::sort(out_.start.begin(), out_.start.end(),
              [this](const auto& a, const auto& b) { return place_of(a.task) < place_of(b.task); });
    out_.stop.clear();
    for (const Assumptions::Start& start : out_.start) out_.stop.push_back(start.task);
  }

  std::vector<std::int32_t> read_priorities(std::string_view task, const Node& node) {
    std::vector<std::int32_t> priorities;
    if (node.kind == Kind::scalar) {
      if (const auto priority = yaml::read_integer(node, task, 1, reporter_)) {
        priorities.push_back(*priority);
      }
    } else if (node.kind != Kind::sequence || node.items.empty()) {
      yaml::report_wrong_type(node, task, "a priority or a list of priorities", reporter_);
    }
    ListedNames listed;
    for (const Node* item : node.items) {
      const auto priority = yaml::read_integer(*item, task, 1, reporter_);
      if (priority && listed.add(static_cast<std::uint32_t>(*priority), *item, reporter_)) {
        priorities.push_back(*priority);
      }
    }
    return priorities;
  }

  void read_stop(const Node& node) {
    if (yaml::read_list(node, "stop", "a list of tasks", reporter_) == nullptr) return;
    out_.stop = read_tasks(node, "stop");
    std::sort(out_.stop.begin(), out_.stop.end(),
              [this](TaskId a, TaskId b) { return place_of(a) < place_of(b); });
  }

  std::vector<TaskId> read_tasks(const Node& list, std::string_view what) {
    std::vector<TaskId> tasks;
    ListedNames listed;
    for (const Node* item : list.items) {
      const auto task = names_.find_task(*item, what, reporter_, &list);
      if (task && listed.add(*task, *item, reporter_)) tasks.push_back(catalog_.task_ids[*task]);
    }
    return tasks;
  }

  void read_changing(const Node& node) {
    constexpr std::string_view expected = "a list of situation variables and behaviors";
    if (yaml::read_list(node, "situation", expected, reporter_) == nullptr) return;
    out_.variables.clear();
    ListedNames variables;
    ListedNames behaviors;
    for (const Node* item : node.items) {
      const auto part = names_.find_part(*item, reporter_, &node);
      if (!part ||
          !(part->is_variable ? variables : behaviors).add(part->place, *item, reporter_)) {
        continue;
      }
      if (part->is_variable) {
        out_.variables.push_back(part->place);
      } else {
        out_.behaviors.push_back(catalog_.behavior_ids[part->place]);
      }
    }
    std::sort(out_.variables.begin(), out_.variables.end());
    sort_behaviors(out_.behaviors);
  }

  void read_never(const Node& node) {
    if (yaml::read_list(node, "never", "a list of situations", reporter_) == nullptr) return;
    for (const Node* item : node.items) {
      const auto situation = read_situation(*item, names_, reporter_);
      if (!situation) continue;
      if (situation->is_empty()) {
        reporter_.report(rule::invalid_value, item->range,
                         "an entry of 'never' must name a variable or a behavior: this one "
                         "excludes every situation");
        continue;
      }
      const SituationPart part = part_of(*situation, catalog_);
      if (knows_first_ && is_first(part)) {
        reporter_.report(rule::invalid_value, item->range,
                         "this excludes the situation at the beginning; 'initially' sets another "
                         "one");
      }
      out_.never.push_back(part);
    }
  }

  [[nodiscard]] bool is_first(const SituationPart& part) const {
    return std::all_of(part.variables.begin(), part.variables.end(),
                       [this](VariableValue value) {
                         return initial_value(out_, value.variable) == value.value;
                       }) &&
           std::all_of(part.behaviors.begin(), part.behaviors.end(),
                       [this](const SituationPart::Own& own) {
                         return is_available_at_first(out_, own.behavior) == own.available;
                       });
  }

  [[nodiscard]] std::uint32_t place_of(TaskId task) const {
    return catalog_.tasks[task].catalog_index;
  }

  NameIndex& names_;
  const CompiledCatalog& catalog_;
  Reporter& reporter_;
  Assumptions out_;
  bool knows_first_ = true;  ///< the situation at the beginning is understood
};

}  // namespace

Assumptions read_assumptions(const Node* assume, const Node* initially, bool knows_all,
                             NameIndex& names, Reporter& reporter) {
  return AssumptionReader(names, reporter).read(assume, initially, knows_all);
}

}  // namespace cbc
