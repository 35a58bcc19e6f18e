
#include <algorithm>
#include <optional>
#include <string>
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

/// What contradicts itself has no meaning.
constexpr Standing of_contradiction{Severity::error, true};

using NamedTask = StateClaims::Task;
using NamedBehavior = StateClaims::Behavior;

/// The place of a key in a mapping that has it.
const Range& range_of(const Node& mapping, std::string_view key) {
  return std::find_if(mapping.entries.begin(), mapping.entries.end(),
                      [key](const auto& entry) { return entry.first->text == key; })
      ->first->range;
}

/// Reads a condition, part by part, and then checks what its parts say together.
class ConditionReader {
 public:
  ConditionReader(const ConditionChecks& checks, NameIndex& names, Reporter& reporter)
      : checks_(checks), names_(names), catalog_(names.catalog()), reporter_(reporter) {}

  StateCondition read(const Node& node, std::string_view what) && {
    if (yaml::read_mapping(node, what, "a mapping", reporter_) == nullptr) return {};
    const std::size_t errors = reporter_.errors();
    Fields fields(node, shape::condition, reporter_);
    if (const Node* part = fields.find("running")) read_running_part(*part);
    if (const Node* part = fields.find("stopped")) read_stopped(*part);
    for (const std::string_view key : {"active", "active_includes"}) {
      if (const Node* part = fields.find(key)) active_ = read_behaviors(*part, key);
    }
    if (fields.has("active")) only_active_ = fields.range_of("active");
    check_active_keys(fields, reporter_);
    if (const Node* part = fields.find("faulty")) faulty_ = read_behaviors(*part, "faulty");
    if (const Node* part = fields.find("available")) {
      available_ = read_behaviors(*part, "available");
    }
    if (const Node* part = fields.find("requested")) read_requested(*part);
    if (const Node* part = fields.find("situation")) read_situation_part(*part);
    fields.report_unknown(yaml::UnknownKeys::refused);
    if (reporter_.errors() > errors) return {};
    check_values();
    check_requested();
    check_available();
    if (reporter_.errors() > errors) return {};
    check_fitting();
    check_constraints();
    check_assumptions();
    StateCondition condition = take();
    if (is_empty(condition)) {
      reporter_.report(rule::missing_key, node.range,
                       quote(what) + " needs a condition: one of " + quoted_list(shape::condition));
    }
    return condition;
  }

 private:
  static std::string quoted_list(const yaml::Shape& shape) {
    std::string text;
    for (const yaml::Key& key : shape.keys) {
      if (!text.empty()) text += key.name == shape.keys.back().name ? " and " : ", ";
      text += quote(key.name);
    }
    return text;
  }

  static bool is_empty(const StateCondition& condition) {
    return condition.running.empty() && condition.stopped.empty() && condition.active.empty() &&
           condition.faulty.empty() && condition.available.empty() && condition.requested.empty() &&
           condition.situation.variables.empty() && condition.situation.behaviors.empty();
  }

  void read_running_part(const Node& node) {
    if (node.kind != Kind::sequence) {
      if (node.kind == Kind::mapping) {
        running_ = read_running(node, names_, of_contradiction, reporter_);
      } else {
        yaml::report_wrong_type(node, "running",
                                "a list of tasks, or a mapping of tasks to behaviors or 'any'",
                                reporter_);
      }
      return;
    }
    if (!read_names(node, "running", "a list of tasks")) return;
    ListedNames listed;
    for (const Node* item : node.items) {
      const auto task = names_.find_task(*item, "running", reporter_, &node);
      if (!task || !listed.add(*task, *item, reporter_)) continue;
      running_.push_back({*task, std::nullopt, item->range, item->range});
    }
  }

  /// Whether the node is a list. An empty one says nothing, and is reported.
  bool read_names(const Node& node, std::string_view what, std::string_view expected) {
    if (yaml::read_list(node, what, expected, reporter_) == nullptr) return false;
    if (!node.items.empty()) return true;
    reporter_.report(rule::invalid_value, node.range,
                     concat(quote(what), " must be ", expected, ", found an empty list"));
    return false;
  }

  void read_stopped(const Node& node) {
    if (!read_names(node, "stopped", "a list of tasks")) return;
    ListedNames listed;
    for (const Node* item : node.items) {
      const auto task = names_.find_task(*item, "stopped", reporter_, &node);
      if (!task || !listed.add(*task, *item, reporter_)) continue;
      check_stopped(*task, item->range, running_, catalog_, of_contradiction, reporter_);
      stopped_.push_back({catalog_.task_ids[*task], item->range});
    }
  }

  std::vector<NamedBehavior> read_behaviors(const Node& node, std::string_view what) {
    std::vector<NamedBehavior> behaviors;
    if (!read_names(node, what, "a list of behaviors")) return behaviors;
    ListedNames listed;
    for (const Node* item : node.items) {
      const auto behavior = names_.find_behavior(*item, what, reporter_, &node);
      if (!behavior || !listed.add(*behavior, *item, reporter_)) continue;
      behaviors.push_back({catalog_.behavior_ids[*behavior], item->range});
    }
    return behaviors;
  }

  void read_requested(const Node& node) {
    if (yaml::read_mapping(node, "requested", "a mapping of tasks to priorities", reporter_) ==
        nullptr) {
      return;
    }
    yaml::report_duplicate_keys(node, reporter_);
    for (const auto& [key, value] : node.entries) {
      const auto task = names_.find_task(*key, "requested", reporter_, &node);
      // A reactive start makes a request with priority 0.
      const auto priority = yaml::read_integer(*value, key->text, 0, reporter_);
      if (!task || !priority) continue;
      requested_.push_back({{catalog_.task_ids[*task], key->range}, *priority});
    }
  }

  void read_situation_part(const Node& node) {
    if (const auto situation = read_situation(node, names_, reporter_)) {
      situation_ = part_of(*situation, catalog_);
      situation_node_ = &node;
    }
  }

  // Contradictions -------------------------------------------------------------------------------

  void refuse(const Range& range, const std::string& why, std::vector<Note> notes = {}) {
    reporter_.report_as(of_contradiction, rule::impossible_expectation, range,
                        "this can never hold: " + why, std::move(notes));
  }

  /// What is said of the values of tasks.
  [[nodiscard]] StateClaims claims() const {
    StateClaims claims;
    for (const RunningEntry& entry : running_) {
      claims.running.push_back(claim_of(entry, catalog_));
    }
    claims.stopped = stopped_;
    claims.active = active_;
    claims.only_active = only_active_;
    return claims;
  }

  void check_values() {
    find_contradictions(claims(), catalog_, reporter_,
                        [this](const Range& range, const std::string& why,
                               std::vector<Note> notes) { refuse(range, why, std::move(notes)); });
  }

  void check_requested() {
    for (const Requested& requested : requested_) {
      const TaskId task = requested.task.id;
      const auto stop = std::find_if(stopped_.begin(), stopped_.end(),
                                     [task](const NamedTask& entry) { return entry.id == task; });
      if (stop == stopped_.end()) continue;
      refuse(requested.task.range,
             "task " + quote(catalog_.name_of_task(task)) +
                 " is also expected to be stopped, and loses its request then",
             {reporter_.note(stop->range, "expected to be stopped here")});
    }
  }

  void check_available() {
    for (const SituationPart::Own& own : situation_.behaviors) {
      if (own.available) continue;
      const auto named =
          std::find_if(available_.begin(), available_.end(),
                       [&own](const NamedBehavior& entry) { return entry.id == own.behavior; });
      if (named == available_.end()) continue;
      const std::string_view name = catalog_.name_of_behavior(own.behavior);
      refuse(named->range, "behavior " + quote(name) + " is also expected to be unavailable",
             {reporter_.note(range_of(*situation_node_, name), "expected to be unavailable here")});
    }
  }

  // What the catalog and the assumptions rule out ------------------------------------------------

  void doubt(const Range& range, const std::string& why, std::vector<Note> notes = {}) {
    const Severity severity = checks_.is_denied ? Severity::note : Severity::warning;
    const char* const what =
        checks_.is_denied ? "this is ruled out already: " : "this can never hold: ";
    reporter_.report_as({severity}, rule::impossible_expectation, range, what + why,
                        std::move(notes));
  }

  void check_fitting() {
    std::vector<NamedBehavior> fitting = available_;
    fitting.insert(fitting.end(), active_.begin(), active_.end());
    for (const RunningEntry& entry : running_) {
      if (!entry.behavior) continue;
      fitting.push_back({catalog_.behavior_ids[*entry.behavior], entry.behavior_range});
    }
    for (const NamedBehavior& behavior : fitting) {
      for (const VariableValue value : situation_.variables) check_fits(behavior, value);
    }
  }

  void check_fits(const NamedBehavior& behavior, VariableValue value) {
    bool is_named = false;
    for (const FittingValue& fitting : catalog_.fitting_values_of(behavior.id)) {
      if (fitting.variable != value.variable) continue;
      if (fitting.value == value.value) return;
      is_named = true;
    }
    if (!is_named) return;
    const std::string_view variable = catalog_.name_of_variable(value.variable);
    doubt(behavior.range,
          "behavior " + quote(catalog_.name_of_behavior(behavior.id)) + " does not fit " +
              quote(concat(variable, ": ", catalog_.name_of_value(value))),
          {reporter_.note(range_of(*situation_node_, variable), "expected here")});
  }

  /// Exclusions of the tasks that run if the condition holds, and their requirements; but what
  /// follows from requirements may well be what a property denies.
  void check_constraints() {
    StateClaims all = claims();
    for (const Requested& requested : requested_) all.running.push_back({requested.task, {}});
    const auto find = checks_.is_denied ? find_excluded : find_ruled_out;
    find(all, catalog_, reporter_,
         [this](const Range& range, const std::string& why, std::vector<Note> notes) {
           doubt(range, why, std::move(notes));
         });
  }

  void check_assumptions() {
    if (checks_.assumptions == nullptr) return;
    const Assumptions& assumptions = *checks_.assumptions;
    if (faulty_.size() > assumptions.faults) {
      doubt(faulty_[assumptions.faults].range,
            assumptions.faults == 0
                ? "no behavior becomes faulty, as 'faults' of 'assume' is 0"
                : concat("'faults' of 'assume' allows only ", assumptions.faults, " at a time"));
    }
    for (const NamedBehavior& behavior : faulty_) {
      if (assumptions.faults == 0 || can_become_faulty(assumptions, behavior.id)) continue;
      doubt(behavior.range, "behavior " + quote(catalog_.name_of_behavior(behavior.id)) +
                                " cannot become faulty by 'faults' of 'assume'");
    }
    for (const Requested& requested : requested_) check_priority(requested, assumptions);
    for (const VariableValue value : situation_.variables) check_variable(value, assumptions);
    for (const SituationPart::Own& own : situation_.behaviors) check_own(own, assumptions);
  }

  void check_variable(VariableValue wanted, const Assumptions& assumptions) {
    if (initial_value(assumptions, wanted.variable) == wanted.value) return;
    const auto& changing = assumptions.variables;
    if (std::find(changing.begin(), changing.end(), wanted.variable) != changing.end()) return;
    report_constant(catalog_.name_of_variable(wanted.variable));
  }

  void check_own(SituationPart::Own wanted, const Assumptions& assumptions) {
    if (is_available_at_first(assumptions, wanted.behavior) == wanted.available) return;
    const auto& changing = assumptions.behaviors;
    if (std::find(changing.begin(), changing.end(), wanted.behavior) != changing.end()) return;
    report_constant(catalog_.name_of_behavior(wanted.behavior));
  }

  void report_constant(std::string_view name) {
    doubt(range_of(*situation_node_, name),
          quote(name) + " never changes, as 'situation' of 'assume' does not list it");
  }

  struct Requested {
    NamedTask task;
    std::int32_t priority = 0;
  };

  void check_priority(const Requested& requested, const Assumptions& assumptions) {
    if (requested.priority == 0) return;
    const auto start = std::find_if(
        assumptions.start.begin(), assumptions.start.end(),
        [&requested](const Assumptions::Start& entry) { return entry.task == requested.task.id; });
    const std::string name = quote(catalog_.name_of_task(requested.task.id));
    if (start == assumptions.start.end()) {
      doubt(requested.task.range,
            "task " + name + " is never requested, as 'start' of 'assume' does not list it");
      return;
    }
    const auto highest = std::max_element(start->priorities.begin(), start->priorities.end());
    if (highest == start->priorities.end() || requested.priority <= *highest) return;
    doubt(requested.task.range,
          concat("'start' of 'assume' requests task ", name, " with at most priority ", *highest));
  }

  StateCondition take() const {
    StateCondition condition;
    for (const RunningEntry& entry : running_) {
      condition.running.push_back({catalog_.task_ids[entry.task],
                                   entry.behavior ? catalog_.behavior_ids[*entry.behavior] : none});
    }
    const auto ids = [](const auto& named) {
      std::vector<decltype(named.front().id)> all;
      all.reserve(named.size());
      for (const auto& entry : named) all.push_back(entry.id);
      return all;
    };
    condition.stopped = ids(stopped_);
    condition.active = ids(active_);
    condition.only_active = only_active_.has_value();
    condition.faulty = ids(faulty_);
    condition.available = ids(available_);
    for (const Requested& requested : requested_) {
      condition.requested.push_back({requested.task.id, requested.priority});
    }
    condition.situation = situation_;
    return condition;
  }

  const ConditionChecks& checks_;
  NameIndex& names_;
  const CompiledCatalog& catalog_;
  Reporter& reporter_;
  std::vector<RunningEntry> running_;
  std::vector<NamedTask> stopped_;
  std::vector<NamedBehavior> active_;
  std::optional<Range> only_active_;
  std::vector<NamedBehavior> faulty_;
  std::vector<NamedBehavior> available_;
  std::vector<Requested> requested_;
  SituationPart situation_;
  const Node* situation_node_ = nullptr;
};

}  // namespace

bool ListedNames::add(std::uint32_t place, const Node& node, Reporter& reporter) {
  const auto [first, is_new] = first_.try_emplace(place, node.range);
  if (!is_new) {
    reporter.report(rule::invalid_value, node.range, quote(node.text) + " is listed twice",
                    {reporter.note(first->second, "first listed here")});
  }
  return is_new;
}

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
  return ConditionReader(checks, names, reporter).read(node, what);
}

}  // namespace cbc
