#include "core/property/condition_checks.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "core/diagnostic/rules.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using NamedTask = StateClaims::Task;
using NamedBehavior = StateClaims::Behavior;

/// What contradicts itself has no meaning.
constexpr Standing of_contradiction{Severity::error, true};

template <typename Item>
void append(std::vector<Item>& items, const std::vector<Item>& more) {
  items.insert(items.end(), more.begin(), more.end());
}

void add(const ConditionClaims& more, ConditionClaims& claims) {
  append(claims.values.running, more.values.running);
  append(claims.values.stopped, more.values.stopped);
  append(claims.values.active, more.values.active);
  append(claims.values.only_active, more.values.only_active);
  append(claims.faulty, more.faulty);
  append(claims.none_faulty, more.none_faulty);
  append(claims.available, more.available);
  append(claims.requested, more.requested);
  append(claims.variables, more.variables);
  append(claims.own, more.own);
}

std::size_t count(const ConditionClaims& claims) {
  return 1 + claims.values.running.size() + claims.values.stopped.size() +
         claims.values.active.size() + claims.faulty.size() + claims.available.size() +
         claims.requested.size() + claims.variables.size() + claims.own.size();
}

/// Why something can never hold.
struct Finding {
  Range range;
  std::string why;
  std::vector<Note> notes;
};

/// Parts that contradict one another whatever the catalog requires and excludes.
class Contradictions {
 public:
  Contradictions(const ConditionClaims& claims, const CompiledCatalog& catalog,
                 const Reporter& reporter)
      : claims_(claims), catalog_(catalog), reporter_(reporter) {}

  std::vector<Finding> find() && {
    find_contradictions(claims_.values, catalog_, reporter_,
                        [this](const Range& range, const std::string& why,
                               std::vector<Note> notes) { add(range, why, std::move(notes)); });
    check_requested();
    check_variables();
    check_available();
    if (!claims_.none_faulty.empty() && !claims_.faulty.empty()) {
      const NamedBehavior& faulty = claims_.faulty.front();
      add(faulty.range,
          concat("behavior ", quote(catalog_.name_of_behavior(faulty.id)),
                 " is expected to be faulty, and no behavior is"),
          {reporter_.note(claims_.none_faulty.front(), "no behavior is to be faulty")});
    }
    return std::move(found_);
  }

 private:
  void add(const Range& range, std::string why, std::vector<Note> notes) {
    found_.push_back({range, std::move(why), std::move(notes)});
  }

  void check_requested() {
    std::unordered_map<TaskId, const NamedTask*> stopped;
    for (const NamedTask& task : claims_.values.stopped) stopped.try_emplace(task.id, &task);
    for (const ConditionClaims::Requested& requested : claims_.requested) {
      const auto stop = stopped.find(requested.task.id);
      if (stop == stopped.end()) continue;
      add(requested.task.range,
          concat("task ", quote(catalog_.name_of_task(requested.task.id)),
                 " is also expected to be stopped, and loses its request then"),
          {reporter_.note(stop->second->range, "expected to be stopped here")});
    }
  }

  /// Of values that are listed in several places, those are left that all of them list.
  void check_variables() {
    struct Left {
      std::set<std::uint32_t> values;
      Range range;
    };
    std::unordered_map<std::uint32_t, Left> left;
    for (const ConditionClaims::Situated& situated : claims_.variables) {
      const std::set<std::uint32_t> listed(situated.part.values.begin(),
                                           situated.part.values.end());
      const auto [found, is_first] =
          left.try_emplace(situated.part.variable, Left{listed, situated.range});
      auto& [values, range] = found->second;
      if (is_first || values.empty()) continue;
      std::erase_if(values, [&](std::uint32_t value) { return !listed.contains(value); });
      if (values.empty()) {
        add(situated.range,
            concat("situation variable ", quote(catalog_.name_of_variable(situated.part.variable)),
                   " is also expected to have another value"),
            {reporter_.note(range, "expected here")});
      }
      range = situated.range;
    }
  }

  void check_available() {
    std::unordered_map<BehaviorId, const ConditionClaims::Own*> first;
    std::unordered_map<BehaviorId, const ConditionClaims::Own*> denied;
    for (const ConditionClaims::Own& own : claims_.own) {
      if (!own.part.available) denied.try_emplace(own.part.behavior, &own);
      const auto [found, is_first] = first.try_emplace(own.part.behavior, &own);
      if (is_first || found->second->part.available == own.part.available) continue;
      const bool is_denied = !own.part.available;
      add(own.range,
          concat("behavior ", quote(catalog_.name_of_behavior(own.part.behavior)),
                 " is also expected to be ", is_denied ? "available" : "unavailable"),
          {reporter_.note(found->second->range, is_denied ? "expected to be available here"
                                                          : "expected to be unavailable here")});
    }
    for (const NamedBehavior& named : claims_.available) {
      const auto found = denied.find(named.id);
      if (found == denied.end()) continue;
      add(named.range,
          concat("behavior ", quote(catalog_.name_of_behavior(named.id)),
                 " is also expected to be unavailable"),
          {reporter_.note(found->second->range, "expected to be unavailable here")});
    }
  }

  const ConditionClaims& claims_;
  const CompiledCatalog& catalog_;
  const Reporter& reporter_;
  std::vector<Finding> found_;
};

/// Parts that the catalog or the assumptions rule out.
class Doubts {
 public:
  Doubts(const ConditionClaims& claims, const ConditionChecks& checks,
         const CompiledCatalog& catalog, const Reporter& reporter)
      : claims_(claims), checks_(checks), catalog_(catalog), reporter_(reporter) {}

  std::vector<Finding> find() && {
    check_fitting();
    check_constraints();
    if (checks_.assumptions != nullptr) check_assumptions(*checks_.assumptions);
    return std::move(found_);
  }

 private:
  void doubt(const Range& range, std::string why, std::vector<Note> notes = {}) {
    found_.push_back({range, std::move(why), std::move(notes)});
  }

  /// Of a task that runs with one of several behaviors, all must be out of place.
  void check_fitting() {
    std::unordered_map<std::uint32_t, std::vector<const ConditionClaims::Situated*>> situated;
    for (const ConditionClaims::Situated& part : claims_.variables) {
      situated[part.part.variable].push_back(&part);
    }
    if (situated.empty()) return;
    const auto find = [&](BehaviorId behavior) { return find_misfit(behavior, situated); };
    std::vector<NamedBehavior> fitting = claims_.available;
    append(fitting, claims_.values.active);
    for (const StateClaims::Running& entry : claims_.values.running) {
      const bool fits =
          std::any_of(entry.behaviors.begin(), entry.behaviors.end(),
                      [&](const NamedBehavior& behavior) { return find(behavior.id) == nullptr; });
      if (!fits) append(fitting, entry.behaviors);
    }
    for (const NamedBehavior& behavior : fitting) {
      if (const auto* misfit = find(behavior.id)) report_misfit(behavior, *misfit);
    }
  }

  /// The part in none of whose values the behavior fits; null if there is none.
  static const ConditionClaims::Situated* first_misfit(
      const std::vector<const ConditionClaims::Situated*>& parts,
      const std::set<std::uint32_t>& values) {
    for (const ConditionClaims::Situated* part : parts) {
      const auto& listed = part->part.values;
      const bool fits = std::any_of(listed.begin(), listed.end(),
                                    [&](std::uint32_t value) { return values.contains(value); });
      if (!fits) return part;
    }
    return nullptr;
  }

  [[nodiscard]] const ConditionClaims::Situated* find_misfit(
      BehaviorId behavior,
      const std::unordered_map<std::uint32_t, std::vector<const ConditionClaims::Situated*>>&
          situated) const {
    std::map<std::uint32_t, std::set<std::uint32_t>> values;
    for (const FittingValue& fitting : catalog_.fitting_values_of(behavior)) {
      if (situated.contains(fitting.variable)) values[fitting.variable].insert(fitting.value);
    }
    for (const auto& [variable, fitting] : values) {
      if (const auto* misfit = first_misfit(situated.at(variable), fitting)) return misfit;
    }
    return nullptr;
  }

  void report_misfit(const NamedBehavior& behavior, const ConditionClaims::Situated& part) {
    std::string values;
    for (const std::uint32_t value : part.part.values) {
      values +=
          concat(values.empty() ? "" : ", ", catalog_.name_of_value({part.part.variable, value}));
    }
    doubt(behavior.range,
          concat("behavior ", quote(catalog_.name_of_behavior(behavior.id)), " does not fit ",
                 quote(concat(catalog_.name_of_variable(part.part.variable), ": ", values))),
          {reporter_.note(part.range, "expected here")});
  }

  /// Exclusions of the tasks that run if the condition holds, and their requirements; but what
  /// follows from requirements may well be what a property denies.
  void check_constraints() {
    StateClaims all = claims_.values;
    for (const auto& requested : claims_.requested) all.running.push_back({requested.task, {}});
    const auto find = checks_.is_denied ? find_excluded : find_ruled_out;
    find(all, catalog_, reporter_,
         [this](const Range& range, const std::string& why, std::vector<Note> notes) {
           doubt(range, why, std::move(notes));
         });
  }

  void check_assumptions(const Assumptions& assumptions) {
    check_faults(assumptions);
    for (const auto& requested : claims_.requested) check_priority(requested, assumptions);
    for (const ConditionClaims::Situated& part : claims_.variables) {
      check_variable(part, assumptions);
    }
    for (const ConditionClaims::Own& own : claims_.own) check_own(own, assumptions);
  }

  void check_faults(const Assumptions& assumptions) {
    std::set<BehaviorId> faulty;
    for (const NamedBehavior& behavior : claims_.faulty) {
      faulty.insert(behavior.id);
      if (faulty.size() <= assumptions.faults) continue;
      doubt(behavior.range,
            assumptions.faults == 0
                ? "no behavior becomes faulty, as 'faults' of 'assume' is 0"
                : concat("'faults' of 'assume' allows only ", assumptions.faults, " at a time"));
      return;
    }
    for (const NamedBehavior& behavior : claims_.faulty) {
      if (assumptions.faults == 0 || can_become_faulty(assumptions, behavior.id)) continue;
      doubt(behavior.range, "behavior " + quote(catalog_.name_of_behavior(behavior.id)) +
                                " cannot become faulty by 'faults' of 'assume'");
    }
  }

  void check_variable(const ConditionClaims::Situated& wanted, const Assumptions& assumptions) {
    const std::uint32_t variable = wanted.part.variable;
    const auto& values = wanted.part.values;
    const auto& changing = assumptions.variables;
    if (std::find(values.begin(), values.end(), initial_value(assumptions, variable)) !=
            values.end() ||
        std::find(changing.begin(), changing.end(), variable) != changing.end()) {
      return;
    }
    report_constant(wanted.range, catalog_.name_of_variable(variable));
  }

  void check_own(const ConditionClaims::Own& wanted, const Assumptions& assumptions) {
    const BehaviorId behavior = wanted.part.behavior;
    if (is_available_at_first(assumptions, behavior) == wanted.part.available) return;
    const auto& changing = assumptions.behaviors;
    if (std::find(changing.begin(), changing.end(), behavior) != changing.end()) return;
    report_constant(wanted.range, catalog_.name_of_behavior(behavior));
  }

  void report_constant(const Range& range, std::string_view name) {
    doubt(range, quote(name) + " never changes, as 'situation' of 'assume' does not list it");
  }

  void check_priority(const ConditionClaims::Requested& requested, const Assumptions& assumptions) {
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

  const ConditionClaims& claims_;
  const ConditionChecks& checks_;
  const CompiledCatalog& catalog_;
  const Reporter& reporter_;
  std::vector<Finding> found_;
};

/// Looks at a condition together with what holds around it.
class ConditionJudge {
 public:
  ConditionJudge(const ConditionChecks& checks, const CompiledCatalog& catalog, Reporter& reporter)
      : checks_(checks), catalog_(catalog), reporter_(reporter) {}

  /// Returns why the condition can never hold with what is claimed around it; empty if it may, or
  /// if that is not known. `is_doubted`: the claims around it are ruled out already.
  std::vector<Finding> judge(const WrittenCondition& condition, const ConditionClaims& around,
                             bool is_doubted) {
    const std::size_t work = count(around);
    if (work > work_left_) return {};
    work_left_ -= work;
    ConditionClaims claims = around;
    add_all(condition, claims);
    std::vector<Finding> found = Contradictions(claims, catalog_, reporter_).find();
    if (!found.empty()) return found;
    if (!is_doubted) {
      const std::vector<Finding> doubts = Doubts(claims, checks_, catalog_, reporter_).find();
      for (const Finding& doubt : doubts) report_doubt(doubt);
      is_doubted = !doubts.empty();
    }
    judge_alternatives(condition, claims, is_doubted, found);
    return found;
  }

 private:
  /// The claims of a condition, and of all that holds with it.
  static void add_all(const WrittenCondition& condition, ConditionClaims& claims) {
    add(condition.claims, claims);
    for (const WrittenCondition& part : condition.all) add_all(part, claims);
  }

  void judge_alternatives(const WrittenCondition& condition, const ConditionClaims& claims,
                          bool is_doubted, std::vector<Finding>& found) {
    std::vector<Finding> impossible;
    bool is_possible = condition.any.empty();
    for (const WrittenCondition& alternative : condition.any) {
      std::vector<Finding> why = judge(alternative, claims, is_doubted);
      is_possible |= why.empty();
      append(impossible, why);
    }
    if (is_possible) {
      for (const Finding& finding : impossible) {
        reporter_.report_as({Severity::warning}, rule::impossible_expectation, finding.range,
                            "this can never hold: " + finding.why, finding.notes);
      }
    } else {
      append(found, impossible);
    }
    for (const WrittenCondition& part : condition.all) {
      judge_alternatives(part, claims, is_doubted, found);
    }
  }

  void report_doubt(const Finding& doubt) {
    const Severity severity = checks_.is_denied ? Severity::note : Severity::warning;
    const char* const what =
        checks_.is_denied ? "this is ruled out already: " : "this can never hold: ";
    reporter_.report_as({severity}, rule::impossible_expectation, doubt.range, what + doubt.why,
                        doubt.notes);
  }

  const ConditionChecks& checks_;
  const CompiledCatalog& catalog_;
  Reporter& reporter_;
  std::size_t work_left_ = 2'000'000;  ///< claims that are looked at
};

}  // namespace

void check_condition(const WrittenCondition& condition, const ConditionChecks& checks,
                     const CompiledCatalog& catalog, Reporter& reporter) {
  const std::vector<Finding> why =
      ConditionJudge(checks, catalog, reporter).judge(condition, {}, false);
  for (const Finding& finding : why) {
    reporter.report_as(of_contradiction, rule::impossible_expectation, finding.range,
                       "this can never hold: " + finding.why, finding.notes);
  }
}

}  // namespace cbc
