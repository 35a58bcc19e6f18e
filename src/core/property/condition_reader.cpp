#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/property/condition_checks.h"
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
  WrittenCondition read(const Node& node, std::string_view what, std::size_t depth = 0) {
    WrittenCondition condition;
    if (yaml::read_mapping(node, what, "a mapping", reporter_) == nullptr) return condition;
    if (depth > most_nested_conditions) {
      reporter_.report(rule::invalid_value, node.range,
                       concat("conditions may stand in one another ", most_nested_conditions,
                              " deep, and this one is deeper"));
      return condition;
    }
    Fields fields(node, shape::condition, reporter_);
    bool is_empty = true;
    const auto find = [&](std::string_view key) {
      const Node* const part = fields.find(key);
      is_empty &= part == nullptr;
      return part;
    };
    ConditionClaims& claims = condition.claims;
    if (const Node* part = find("running")) claims.values.running = read_running_part(*part);
    if (const Node* part = find("stopped")) claims.values.stopped = read_tasks(*part, "stopped");
    if (const Node* part = find("active")) {
      claims.values.active = read_behaviors(*part, "active");
      StateClaims::Only& only = claims.values.only_active.emplace_back();
      only.range = fields.range_of("active");
      for (const auto& behavior : claims.values.active) only.behaviors.push_back(behavior.id);
    }
    if (const Node* part = find("active_includes")) {
      claims.values.active = read_behaviors(*part, "active_includes");
    }
    check_active_keys(fields, reporter_);
    if (const Node* part = find("faulty")) read_faulty(*part, fields.range_of("faulty"), claims);
    if (const Node* part = find("available")) {
      claims.available = read_behaviors(*part, "available");
    }
    if (const Node* part = find("requested")) read_requested(*part, claims);
    if (const Node* part = find("situation")) read_situation_part(*part, claims);
    if (const Node* part = find("not")) condition.negated.push_back(read(*part, "not", depth + 1));
    if (const Node* part = find("any")) condition.any = read_conditions(*part, "any", depth);
    if (const Node* part = find("all")) condition.all = read_conditions(*part, "all", depth);
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

  std::vector<WrittenCondition> read_conditions(const Node& node, std::string_view what,
                                                std::size_t depth) {
    std::vector<WrittenCondition> conditions;
    if (!read_items(node, what, "a list of conditions")) return conditions;
    for (const Node* item : node.items) conditions.push_back(read(*item, what, depth + 1));
    return conditions;
  }

  std::vector<StateClaims::Running> read_running_part(const Node& node) {
    constexpr std::string_view expected =
        "a list of tasks, or a mapping of tasks to behaviors or 'any'";
    std::vector<StateClaims::Running> running;
    if (!has_entries(node, "running", expected)) return running;
    if (node.kind == Kind::mapping) return read_running(node, names_, reporter_);
    if (node.kind != Kind::sequence) {
      yaml::report_wrong_type(node, "running", expected, reporter_);
      return running;
    }
    for (const StateClaims::Task& task : read_tasks(node, "running")) running.push_back({task, {}});
    return running;
  }

  std::vector<StateClaims::Task> read_tasks(const Node& node, std::string_view what) {
    std::vector<StateClaims::Task> tasks;
    if (!read_items(node, what, "a list of tasks")) return tasks;
    ListedNames listed;
    for (const Node* item : node.items) {
      const auto task = names_.find_task(*item, what, reporter_, &node);
      if (!task || !listed.add(*task, *item, reporter_)) continue;
      tasks.push_back({catalog_.task_ids[*task], item->range});
    }
    return tasks;
  }

  std::vector<StateClaims::Behavior> read_behaviors(
      const Node& node, std::string_view what, std::string_view expected = "a list of behaviors") {
    std::vector<StateClaims::Behavior> behaviors;
    if (!read_items(node, what, expected)) return behaviors;
    ListedNames listed;
    for (const Node* item : node.items) {
      const auto behavior = names_.find_behavior(*item, what, reporter_, &node);
      if (!behavior || !listed.add(*behavior, *item, reporter_)) continue;
      behaviors.push_back({catalog_.behavior_ids[*behavior], item->range});
    }
    return behaviors;
  }

  void read_faulty(const Node& node, const Range& key, ConditionClaims& claims) {
    if (node.kind == Kind::scalar && node.text == "none") {
      claims.none_faulty.push_back(key);
    } else {
      claims.faulty = read_behaviors(node, "faulty", "a list of behaviors or 'none'");
    }
  }

  void read_requested(const Node& node, ConditionClaims& claims) {
    constexpr std::string_view expected = "a mapping of tasks to priorities";
    if (!has_entries(node, "requested", expected)) return;
    if (yaml::read_mapping(node, "requested", expected, reporter_) == nullptr) return;
    yaml::report_duplicate_keys(node, reporter_);
    for (const auto& [key, value] : node.entries) {
      const auto task = names_.find_task(*key, "requested", reporter_, &node);
      // A reactive start makes a request with priority 0.
      const auto priority = yaml::read_integer(*value, key->text, 0, reporter_);
      if (!task || !priority) continue;
      claims.requested.push_back({{catalog_.task_ids[*task], key->range}, *priority});
    }
  }

  void read_situation_part(const Node& node, ConditionClaims& claims) {
    if (!has_entries(node, "situation", "a mapping of variables to values")) return;
    auto entries = read_possible_situation(node, names_, reporter_);
    if (!entries) return;
    for (SituationEntry& entry : *entries) {
      if (entry.part.is_variable) {
        claims.variables.push_back({{entry.part.place, std::move(entry.values)}, entry.range});
      } else {
        claims.own.push_back(
            {{catalog_.behavior_ids[entry.part.place], entry.available}, entry.range});
      }
    }
  }

  NameIndex& names_;
  const CompiledCatalog& catalog_;
  Reporter& reporter_;
};

StateCondition condition_of(const WrittenCondition& written) {
  const auto ids = [](const auto& named) {
    std::vector<decltype(named.front().id)> all;
    all.reserve(named.size());
    for (const auto& entry : named) all.push_back(entry.id);
    return all;
  };
  const auto parts = [](const std::vector<WrittenCondition>& inner) {
    std::vector<StateCondition> all;
    all.reserve(inner.size());
    for (const WrittenCondition& part : inner) all.push_back(condition_of(part));
    return all;
  };
  const ConditionClaims& claims = written.claims;
  StateCondition condition;
  for (const StateClaims::Running& entry : claims.values.running) {
    condition.running.push_back({entry.task.id, ids(entry.behaviors)});
  }
  condition.stopped = ids(claims.values.stopped);
  condition.active = ids(claims.values.active);
  condition.only_active = !claims.values.only_active.empty();
  condition.faulty = ids(claims.faulty);
  condition.none_faulty = !claims.none_faulty.empty();
  condition.available = ids(claims.available);
  for (const auto& entry : claims.requested) {
    condition.requested.push_back({entry.task.id, entry.priority});
  }
  for (const auto& entry : claims.variables) condition.variables.push_back(entry.part);
  for (const auto& entry : claims.own) condition.own.push_back(entry.part);
  condition.negated = parts(written.negated);
  condition.any = parts(written.any);
  condition.all = parts(written.all);
  return condition;
}

}  // namespace

SituationPart part_of(const Situation& situation, const CompiledCatalog& catalog) {
  SituationPart part;
  part.variables = situation.variables;
  for (const Availability& entry : situation.availability) {
    part.behaviors.push_back({catalog.behavior_ids[entry.behavior], entry.available});
  }
  return part;
}

StateCondition read_condition(const Node& node, std::string_view what,
                              const ConditionChecks& checks, NameIndex& names, Reporter& reporter) {
  const std::size_t errors = reporter.errors();
  const WrittenCondition written = ConditionReader(names, reporter).read(node, what);
  if (reporter.errors() > errors) return {};
  check_condition(written, checks, names.catalog(), reporter);
  return condition_of(written);
}

}  // namespace cbc
