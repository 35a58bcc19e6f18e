#include "core/script/condition.h"

#include <numeric>
#include <span>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// Words for a condition, and what they are made of.
struct Phrase {
  enum class Form : std::uint8_t { single, conjunction, alternatives };
  std::string text;
  Form form = Form::single;

  [[nodiscard]] std::string in_parentheses() const {
    return form == Form::single ? text : "(" + text + ")";
  }
};

class ConditionWords {
 public:
  explicit ConditionWords(const CompiledCatalog& catalog) : catalog_(catalog) {}

  [[nodiscard]] Phrase describe(const StateCondition& condition) const {
    const auto in_form = [](std::string text, std::size_t ways) {
      return Phrase{std::move(text), ways > 1 ? Phrase::Form::alternatives : Phrase::Form::single};
    };
    switch (condition.kind) {
      case Kind::all:
        return describe_all(condition);
      case Kind::any: {
        if (condition.parts.size() == 1) return describe(condition.parts.front());
        const auto word = [this](const StateCondition& part) {
          return describe(part).in_parentheses();
        };
        return {join(condition.parts, " or ", word), Phrase::Form::alternatives};
      }
      case Kind::negated:
        return {concat("not (", describe(condition.parts.front()).text, ")")};
      case Kind::running:
        return in_form(describe_running(catalog_, condition.task, condition.behaviors),
                       condition.behaviors.size());
      case Kind::stopped:
        return {task(condition) + " does not run"};
      case Kind::active:
        return {concat("behavior ", behavior(condition), " is active")};
      case Kind::only_active:
        return describe_only(condition);
      case Kind::faulty:
        return {concat("behavior ", behavior(condition), " is faulty")};
      case Kind::none_faulty:
        return {"no behavior is faulty"};
      case Kind::failed:
        return {concat("behavior ", behavior(condition), " has failed, and is not tried again")};
      case Kind::suspended:
        return {concat("the request of ", task(condition), " is suspended")};
      case Kind::available:
        return {concat("behavior ", behavior(condition), " is available")};
      case Kind::requested:
        return {concat(task(condition), " is requested with priority ", condition.priority,
                       " or more")};
      case Kind::variable: {
        std::vector<std::string> values;
        for (const std::uint32_t value : condition.values) {
          values.push_back(printable(catalog_.name_of_value({condition.variable, value})));
        }
        return in_form(concat(printable(catalog_.name_of_variable(condition.variable)), " is ",
                              list_with_or(values)),
                       values.size());
      }
      case Kind::own:
        return {concat("the situation ", condition.wanted ? "allows " : "forbids ",
                       behavior(condition))};
    }
    return {};
  }

 private:
  using Kind = StateCondition::Kind;

  [[nodiscard]] Phrase describe_all(const StateCondition& condition) const {
    std::vector<Phrase> phrases;
    add_parts(condition, phrases);
    if (phrases.size() == 1) return phrases.front();
    const auto word = [](const Phrase& part) {
      return part.form == Phrase::Form::alternatives ? part.in_parentheses() : part.text;
    };
    return {join(phrases, " and ", word), Phrase::Form::conjunction};
  }

  void add_parts(const StateCondition& condition, std::vector<Phrase>& phrases) const {
    for (const StateCondition& part : condition.parts) {
      if (part.kind == Kind::all) {
        add_parts(part, phrases);
      } else {
        phrases.push_back(describe(part));
      }
    }
  }

  [[nodiscard]] Phrase describe_only(const StateCondition& condition) const {
    if (condition.parts.empty()) return {"no behavior is active"};
    const auto name = [this](const StateCondition& part) { return behavior(part); };
    const bool is_one = condition.parts.size() == 1;
    return {concat("only ", is_one ? "behavior " : "the behaviors ",
                   join(condition.parts, ", ", name), is_one ? " is active" : " are active")};
  }

  [[nodiscard]] std::string task(const StateCondition& atom) const {
    return printable(catalog_.name_of_task(atom.task));
  }
  [[nodiscard]] std::string behavior(const StateCondition& atom) const {
    return printable(catalog_.name_of_behavior(atom.behavior));
  }

  const CompiledCatalog& catalog_;
};

std::vector<GroupId> all_groups(const CompiledCatalog& catalog) {
  std::vector<GroupId> groups(catalog.group_count());
  std::iota(groups.begin(), groups.end(), GroupId(0));
  return groups;
}

}  // namespace

std::string describe_running(const CompiledCatalog& catalog, TaskId task,
                             std::span<const BehaviorId> behaviors) {
  const std::string text = printable(catalog.name_of_task(task)) + " runs";
  if (behaviors.empty()) return text;
  std::vector<std::string> names;
  for (const BehaviorId id : behaviors) names.push_back(printable(catalog.name_of_behavior(id)));
  return text + " with " + list_with_or(names);
}

std::string describe_condition(const CompiledCatalog& catalog, const StateCondition& condition) {
  return ConditionWords(catalog).describe(condition).text;
}

ConditionFormula::ConditionFormula(const CompiledCatalog& catalog, std::vector<GroupId> groups)
    : catalog_(catalog), maker_(catalog), groups_(std::move(groups)) {}

ConditionFormula::ConditionFormula(const CompiledCatalog& catalog)
    : ConditionFormula(catalog, all_groups(catalog)) {}

Formula ConditionFormula::make(const StateCondition& condition, bool holds) const {
  using Kind = StateCondition::Kind;
  const auto of_parts = [&](bool all) {
    Formula formula = FormulaMaker::join(all);
    for (const StateCondition& part : condition.parts) formula.parts.push_back(make(part, holds));
    return formula;
  };
  const Formula anything = FormulaMaker::join(true);
  switch (condition.kind) {
    case Kind::all:
      return of_parts(holds);
    case Kind::any:
      return of_parts(!holds);
    case Kind::negated:
      return make(condition.parts.front(), !holds);
    case Kind::running:
      return maker_.runs(condition.task, condition.behaviors, holds);
    case Kind::stopped:
      return maker_.runs(condition.task, {}, !holds);
    case Kind::active:
      return maker_.active(condition.behavior, holds);
    case Kind::only_active: {
      Formula formula = of_parts(holds);
      formula.parts.push_back(no_other(condition, holds));
      return formula;
    }
    case Kind::faulty:
      return FormulaMaker::faulty(condition.behavior, holds);
    case Kind::none_faulty:
      return FormulaMaker::none_faulty(behaviors(), holds);
    case Kind::available:
      // What is in X is not available.
      if (!holds && catalog_.retry_of(condition.behavior) != Retry::at_events) return anything;
      return maker_.available(condition.behavior, holds);
    case Kind::failed:
      if (!holds) return anything;
      return catalog_.retry_of(condition.behavior) == Retry::at_events
                 ? FormulaMaker::join(false)
                 : maker_.active(condition.behavior, false);
    case Kind::requested:
      // A task without such a request may run or not; and a request may be suspended.
      return holds && catalog_.rules_of(condition.task).resume == 0
                 ? maker_.runs(condition.task, {}, true)
                 : anything;
    case Kind::suspended:
      if (!holds) return anything;
      return catalog_.rules_of(condition.task).resume == 0 ? FormulaMaker::join(false)
                                                           : maker_.runs(condition.task, {}, false);
    case Kind::variable:
      return maker_.has_value(condition.variable, condition.values, holds);
    case Kind::own:
      return FormulaMaker::own(condition.behavior, condition.wanted == holds);
  }
  return {};
}

Formula ConditionFormula::no_other(const StateCondition& only_active, bool holds) const {
  std::vector<bool> is_listed(catalog_.behaviors.size(), false);
  for (const StateCondition& part : only_active.parts) is_listed[part.behavior] = true;
  Formula formula = FormulaMaker::join(holds);
  for (const GroupId group : groups_) {
    for (TaskId task = catalog_.group_tasks[group]; task < catalog_.group_tasks[group + 1];
         ++task) {
      Formula of_task{Formula::Kind::task, task, {}, holds};
      for (ValueId value(catalog_.values.begin[task]); value < catalog_.values.begin[task + 1];
           ++value) {
        const bool may_have = is_listed[catalog_.values.items[value].behavior];
        if (may_have == holds) of_task.values.push_back(value);
      }
      formula.parts.push_back(std::move(of_task));
    }
  }
  return formula;
}

std::vector<BehaviorId> ConditionFormula::behaviors() const {
  std::vector<BehaviorId> behaviors;
  for (const GroupId group : groups_) {
    for (BehaviorId behavior = catalog_.group_behaviors[group];
         behavior < catalog_.group_behaviors[group + 1]; ++behavior) {
      behaviors.push_back(behavior);
    }
  }
  return behaviors;
}

}  // namespace cbc
