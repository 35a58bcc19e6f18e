#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/property/property_reader.h"
#include "core/script/expectation.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {
namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

/// Reads a condition, and those that stand in it.
class ConditionReader {
 public:
  ConditionReader(NameIndex& names, Reporter& reporter)
      : names_(names), catalog_(names.catalog()), reporter_(reporter) {}

  /// `depth`: in how many others it stands.
  StateCondition read(const Node& node, std::string_view what, std::size_t depth = 0) {
    StateCondition condition;
    condition.range = node.range;
    if (yaml::read_mapping(node, what, "a mapping", reporter_) == nullptr) return condition;
    if (depth > most_nested_conditions) {
      reporter_.report(rule::invalid_value, node.range,
                       concat("conditions may stand in one another ", most_nested_conditions,
                              " deep, and this one is deeper"));
      return condition;
    }
    Fields fields(node, shape::condition, reporter_);
    bool is_empty = true;
    for (const auto& [key, read_value] : values) {
      const Node* const value = fields.find(key);
      if (value == nullptr) continue;
      is_empty = false;
      (this->*read_value)(*value, {key, fields.range_of(key), depth + 1}, condition.parts);
    }
    check_active_keys(fields, reporter_);
    const std::size_t errors = reporter_.errors();
    fields.report_unknown(yaml::UnknownKeys::refused);
    if (is_empty && reporter_.errors() == errors) {
      reporter_.report(
          rule::missing_key, node.range,
          quote(what) + " needs a condition: one of " + yaml::list_keys(shape::condition));
    }
    return condition;
  }

 private:
  /// Whether the node is a list. An empty one says nothing, and is reported.
  bool read_items(const Node& node, std::string_view what, std::string_view expected) {
    if (yaml::read_list(node, what, expected, reporter_) == nullptr) return false;
    if (!node.items.empty()) return true;
    reporter_.report(rule::invalid_value, node.range,
                     concat(quote(what), " must be ", expected, ", found an empty list"));
    return false;
  }

  /// A mapping without entries says nothing, either.
  bool has_entries(const Node& node, std::string_view what, std::string_view expected) {
    if (node.kind != Kind::mapping || !node.entries.empty()) return true;
    reporter_.report(rule::invalid_value, node.range,
                     concat(quote(what), " must be ", expected, ", found an empty mapping"));
    return false;
  }

  /// The key of a value, and in how many others the conditions in it stand.
  struct Place {
    std::string_view key;
    Range range;
    std::size_t depth = 0;
  };
  using Conditions = std::vector<StateCondition>;

  void read_running_part(const Node& node, const Place& /*place*/, Conditions& conditions) {
    constexpr std::string_view expected =
        "a list of tasks, or a mapping of tasks to behaviors or 'any'";
    if (!has_entries(node, "running", expected)) return;
    if (node.kind == Kind::mapping) return read_running(node, names_, reporter_, conditions);
    if (node.kind != Kind::sequence) {
      return yaml::report_wrong_type(node, "running", expected, reporter_);
    }
    read_tasks(node, "running", StateCondition::Kind::running, conditions);
  }

  void read_suspended(const Node& node, const Place& place, Conditions& conditions) {
    read_tasks(node, place.key, StateCondition::Kind::suspended, conditions);
  }
  void read_failed(const Node& node, const Place& place, Conditions& conditions) {
    read_behaviors(node, place.key, StateCondition::Kind::failed, conditions);
  }
  void read_stopped(const Node& node, const Place& place, Conditions& conditions) {
    read_tasks(node, place.key, StateCondition::Kind::stopped, conditions);
  }

  void read_tasks(const Node& node, std::string_view what, StateCondition::Kind kind,
                  Conditions& conditions) {
    if (!read_items(node, what, "a list of tasks")) return;
    ListedNames listed;
    for (const Node* item : node.items) {
      const auto task = names_.find_task(*item, what, reporter_, &node);
      if (!task || !listed.add(*task, *item, reporter_)) continue;
      conditions.push_back(StateCondition::of_task(kind, catalog_.task_ids[*task]));
      conditions.back().range = item->range;
    }
  }

  void read_active(const Node& node, const Place& place, Conditions& conditions) {
    StateCondition& only =
        conditions.emplace_back(StateCondition{StateCondition::Kind::only_active});
    only.range = place.range;
    read_behaviors(node, "active", StateCondition::Kind::active, only.parts);
  }
  void read_active_includes(const Node& node, const Place& place, Conditions& conditions) {
    read_behaviors(node, place.key, StateCondition::Kind::active, conditions);
  }
  void read_available(const Node& node, const Place& place, Conditions& conditions) {
    read_behaviors(node, place.key, StateCondition::Kind::available, conditions);
  }

  void read_behaviors(const Node& node, std::string_view what, StateCondition::Kind kind,
                      Conditions& conditions, std::string_view expected = "a list of behaviors") {
    if (!read_items(node, what, expected)) return;
    ListedNames listed;
    for (const Node* item : node.items) {
      const auto behavior = names_.find_behavior(*item, what, reporter_, &node);
      if (!behavior || !listed.add(*behavior, *item, reporter_)) continue;
      conditions.push_back(StateCondition::of_behavior(kind, catalog_.behavior_ids[*behavior]));
      conditions.back().range = item->range;
    }
  }

  void read_faulty(const Node& node, const Place& place, Conditions& conditions) {
    if (node.kind == Kind::scalar && node.text == "none") {
      conditions.push_back(StateCondition{StateCondition::Kind::none_faulty});
      conditions.back().range = place.range;
    } else {
      read_behaviors(node, "faulty", StateCondition::Kind::faulty, conditions,
                     "a list of behaviors or 'none'");
    }
  }

  void read_requested(const Node& node, const Place& /*place*/, Conditions& conditions) {
    constexpr std::string_view expected = "a mapping of tasks to priorities";
    if (!has_entries(node, "requested", expected)) return;
    if (yaml::read_mapping(node, "requested", expected, reporter_) == nullptr) return;
    yaml::report_duplicate_keys(node, reporter_);
    for (const auto& [key, value] : node.entries) {
      const auto task = names_.find_task(*key, "requested", reporter_, &node);
      // A reactive start makes a request with priority 0.
      const auto priority = yaml::read_integer(*value, key->text, 0, reporter_);
      if (!task || !priority) continue;
      conditions.push_back(StateCondition::requested(catalog_.task_ids[*task], *priority));
      conditions.back().range = key->range;
    }
  }

  void read_situation_part(const Node& node, const Place& /*place*/, Conditions& conditions) {
    if (!has_entries(node, "situation", "a mapping of variables to values")) return;
    auto entries = read_possible_situation(node, names_, reporter_);
    if (!entries) return;
    for (SituationEntry& entry : *entries) {
      conditions.push_back(
          entry.part.is_variable
              ? StateCondition::of_variable(entry.part.place, std::move(entry.values))
              : StateCondition::own(catalog_.behavior_ids[entry.part.place], entry.available));
      conditions.back().range = entry.range;
    }
  }

  void read_not(const Node& node, const Place& place, Conditions& conditions) {
    StateCondition inner = read(node, place.key, place.depth);
    conditions.push_back(StateCondition::join(StateCondition::Kind::negated, {std::move(inner)}));
    conditions.back().range = place.range;
  }
  void read_any(const Node& node, const Place& place, Conditions& conditions) {
    read_conditions(node, place, StateCondition::Kind::any, conditions);
  }
  void read_all(const Node& node, const Place& place, Conditions& conditions) {
    read_conditions(node, place, StateCondition::Kind::all, conditions);
  }

  void read_conditions(const Node& node, const Place& place, StateCondition::Kind kind,
                       Conditions& conditions) {
    if (!read_items(node, place.key, "a list of conditions")) return;
    StateCondition& joined = conditions.emplace_back(StateCondition{kind});
    joined.range = place.range;
    for (const Node* item : node.items) {
      joined.parts.push_back(read(*item, place.key, place.depth));
    }
  }

  /// What reads the value of a key, and appends what it says.
  struct Value {
    std::string_view key;
    void (ConditionReader::*read)(const Node&, const Place&, Conditions&);
  };
  static constexpr Value values[] = {{"running", &ConditionReader::read_running_part},
                                     {"stopped", &ConditionReader::read_stopped},
                                     {"active", &ConditionReader::read_active},
                                     {"active_includes", &ConditionReader::read_active_includes},
                                     {"requested", &ConditionReader::read_requested},
                                     {"suspended", &ConditionReader::read_suspended},
                                     {"failed", &ConditionReader::read_failed},
                                     {"situation", &ConditionReader::read_situation_part},
                                     {"available", &ConditionReader::read_available},
                                     {"faulty", &ConditionReader::read_faulty},
                                     {"not", &ConditionReader::read_not},
                                     {"any", &ConditionReader::read_any},
                                     {"all", &ConditionReader::read_all}};

  NameIndex& names_;
  const CompiledCatalog& catalog_;
  Reporter& reporter_;
};

}  // namespace

SituationPart part_of(const Situation& situation, const CompiledCatalog& catalog) {
  SituationPart part;
  part.variables = situation.variables;
  for (const Availability& entry : situation.availability) {
    part.behaviors.push_back({catalog.behavior_ids[entry.behavior], entry.available});
  }
  return part;
}

StateCondition read_condition(const Node& node, std::string_view what, NameIndex& names,
                              Reporter& reporter) {
  return ConditionReader(names, reporter).read(node, what);
}

}  // namespace cbc
