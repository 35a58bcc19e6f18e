#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/property/frozen_variables.h"
#include "core/property/property_reader.h"
#include "core/script/names.h"
#include "core/support/wording.h"
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
    const std::size_t errors = reporter_.errors();
    out_ = default_assumptions(catalog_);
    knows_first_ = knows_all;
    if (initially != nullptr) read_initially(*initially);
    if (assume != nullptr &&
        yaml::read_mapping(*assume, "assume", "a mapping", reporter_) != nullptr) {
      read_assume(*assume);
    }
    if (knows_first_ && reporter_.errors() == errors) report_frozen();
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
    if (const Node* failures = fields.find("failures")) read_failures(*failures);
    if (const Node* suspended = fields.find("suspended")) {
      out_.most_suspended = read_most_of(*suspended, "suspended", shape::suspended);
    }
    if (const Node* faults = fields.find("faults")) read_faults(*faults);
    const std::size_t errors = reporter_.errors();
    if (const Node* situation = fields.find("situation")) read_changing(*situation);
    knows_changing_ = reporter_.errors() == errors && !fields.has_unknown();
    if (const Node* together = fields.find("together")) read_together(*together);
    if (const Node* never = fields.find("never")) read_never(*never);
    fields.report_unknown(yaml::UnknownKeys::refused);
  }

  void read_failures(const Node& node) {
    if (node.kind == Kind::mapping) {
      out_.most_failed = read_most_of(node, "failures", shape::failures);
    } else {
      out_.failures = yaml::read_boolean(node, "failures", reporter_).value_or(out_.failures);
    }
  }

  /// "{most: 2}"
  std::optional<std::uint32_t> read_most_of(const Node& node, std::string_view what,
                                            const yaml::Shape& form) {
    if (yaml::read_mapping(node, what, "a mapping with 'most'", reporter_) == nullptr) return {};
    Fields fields(node, form, reporter_);
    std::optional<std::uint32_t> number;
    if (const Node* most = fields.find("most")) {
      if (const auto read = yaml::read_integer(*most, "most", 0, reporter_)) {
        number = static_cast<std::uint32_t>(*read);
      }
    } else if (!fields.has_unknown()) {
      reporter_.report(rule::missing_key, node.range,
                       concat(quote(what), " needs 'most': a number of behaviors or tasks"));
    }
    fields.report_unknown(yaml::UnknownKeys::refused);
    return number;
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
        const auto task = names_.find_requestable(*key, "start", reporter_, &node);
        std::vector<std::int32_t> priorities = read_priorities(key->text, *value);
        if (task) out_.start.push_back({catalog_.task_ids[*task], std::move(priorities)});
      }
    } else if (node.kind == Kind::sequence) {
      for (const TaskId task : read_tasks(node, "start", &NameIndex::find_requestable)) {
        out_.start.push_back({task, {1}});
      }
    } else if (node.text == "all") {
      for (const TaskId task : catalog_.task_ids) {
        if (catalog_.rules_of(task).requestable != 0) out_.start.push_back({task, {1}});
      }
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

  std::vector<TaskId> read_tasks(const Node& list, std::string_view what,
                                 NameIndex::Find find = &NameIndex::find_task) {
    std::vector<TaskId> tasks;
    ListedNames listed;
    for (const Node* item : list.items) {
      const auto task = (names_.*find)(*item, what, reporter_, &list);
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

  void read_together(const Node& node) {
    constexpr std::string_view expected = "a list of lists of situation variables";
    if (yaml::read_list(node, "together", expected, reporter_) == nullptr) return;
    for (const Node* item : node.items) {
      const std::size_t errors = reporter_.errors();
      std::vector<std::uint32_t> variables = read_variables(*item);
      if (reporter_.errors() > errors) continue;
      if (variables.size() < 2) {
        reporter_.report(rule::invalid_value, item->range,
                         concat("expected at least two variables that change at once, found ",
                                variables.size() == 1 ? "one" : "none"));
      } else if (count_combinations(catalog_, variables) > most_values_together) {
        reporter_.report(rule::invalid_value, item->range,
                         concat("expected at most ", most_values_together,
                                " combinations of values of the variables of a list, found more"));
      } else {
        out_.together.push_back(std::move(variables));
      }
    }
  }

  std::vector<std::uint32_t> read_variables(const Node& list) {
    std::vector<std::uint32_t> variables;
    constexpr std::string_view expected = "lists of situation variables";
    if (yaml::read_list(list, "together", expected, reporter_) == nullptr) return variables;
    ListedNames listed;
    for (const Node* item : list.items) {
      const auto part = names_.find_part(*item, reporter_, &list);
      if (!part) continue;
      if (!part->is_variable) {
        reporter_.report(
            rule::invalid_value, item->range,
            concat("'together' lists situation variables, found behavior ", quote(item->text)));
      } else if (!may_change(part->place)) {
        reporter_.report(rule::invalid_value, item->range,
                         concat(quote(item->text),
                                " never changes, as 'situation' of 'assume' does not list it"));
      } else if (listed.add(part->place, *item, reporter_)) {
        variables.push_back(part->place);
      }
    }
    std::sort(variables.begin(), variables.end());
    return variables;
  }

  /// Also if that is not known.
  [[nodiscard]] bool may_change(std::uint32_t variable) const {
    return !knows_changing_ ||
           std::binary_search(out_.variables.begin(), out_.variables.end(), variable);
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
      if (knows_first_ && holds_at_first(out_, part)) {
        reporter_.report(rule::invalid_value, item->range,
                         "this excludes the situation at the beginning; 'initially' sets another "
                         "one");
      }
      out_.never.push_back(part);
      never_ranges_.push_back(item->range);
    }
  }

  /// Where other values would be possible, but no move leads to them, proofs would be vacuous.
  void report_frozen() {
    for (const FrozenVariables& frozen : find_frozen_variables(catalog_, out_)) {
      out_.frozen.insert(out_.frozen.end(), frozen.variables.begin(), frozen.variables.end());
      if (frozen.together.empty()) continue;
      std::vector<Note> notes;
      for (std::size_t place = 1; place < frozen.entries.size(); ++place) {
        notes.push_back(reporter_.note(never_ranges_[frozen.entries[place]], "as does this"));
      }
      reporter_.report_as(
          {Severity::warning}, rule::impossible_expectation, never_ranges_[frozen.entries.front()],
          concat("'never' keeps ", quoted(frozen.coupled),
                 " from ever changing, as it excludes each change of one variable; ",
                 quote(concat("together: [[", listed(frozen.together), "]]")),
                 " lets several change at once"),
          std::move(notes));
    }
    std::sort(out_.frozen.begin(), out_.frozen.end());
  }

  [[nodiscard]] std::string listed(const std::vector<std::uint32_t>& variables) const {
    return join(variables, ", ", [this](std::uint32_t variable) {
      return std::string(catalog_.name_of_variable(variable));
    });
  }
  [[nodiscard]] std::string quoted(const std::vector<std::uint32_t>& variables) const {
    std::vector<std::string> names;
    names.reserve(variables.size());
    for (const std::uint32_t variable : variables) {
      names.push_back(quote(catalog_.name_of_variable(variable)));
    }
    return list_with_and(names);
  }

  [[nodiscard]] std::uint32_t place_of(TaskId task) const {
    return catalog_.tasks[task].catalog_index;
  }

  NameIndex& names_;
  const CompiledCatalog& catalog_;
  Reporter& reporter_;
  Assumptions out_;
  std::vector<Range> never_ranges_;  ///< by entry
  bool knows_first_ = true;          ///< the situation at the beginning is understood
  bool knows_changing_ = true;       ///< what may change is understood
};

}  // namespace

Assumptions read_assumptions(const Node* assume, const Node* initially, bool knows_all,
                             NameIndex& names, Reporter& reporter) {
  return AssumptionReader(names, reporter).read(assume, initially, knows_all);
}

}  // namespace cbc
