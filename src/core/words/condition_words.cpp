#include "core/words/condition_words.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "core/words/words.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// Words for a condition, and what they are made of.
struct Phrase {
  enum class Kind : std::uint8_t { single, conjunction, alternatives };
  Kind kind = Kind::single;
  std::string text;

  [[nodiscard]] std::string in_parentheses() const {
    return kind == Kind::single ? text : "(" + text + ")";
  }
};

class ConditionWords {
 public:
  explicit ConditionWords(const CompiledCatalog& catalog) : catalog_(catalog) {}

  [[nodiscard]] Phrase describe(const StateCondition& condition) const {
    std::vector<Phrase> parts;
    add(condition, parts);
    if (parts.size() == 1) return parts.front();
    const auto word = [](const Phrase& part) {
      return part.kind == Phrase::Kind::alternatives ? part.in_parentheses() : part.text;
    };
    return {Phrase::Kind::conjunction, join(parts, " and ", word)};
  }

 private:
  /// All parts, those of `all` included.
  void add(const StateCondition& condition, std::vector<Phrase>& parts) const {
    add_tasks(condition, parts);
    add_environment(condition, parts);
    for (const StateCondition& part : condition.negated) {
      parts.push_back({Phrase::Kind::single, "not (" + describe(part).text + ")"});
    }
    if (!condition.any.empty()) {
      std::vector<Phrase> alternatives;
      for (const StateCondition& part : condition.any) alternatives.push_back(describe(part));
      parts.push_back(alternatives.size() == 1
                          ? alternatives.front()
                          : Phrase{Phrase::Kind::alternatives,
                                   join(alternatives, " or ", [](const Phrase& alternative) {
                                     return alternative.in_parentheses();
                                   })});
    }
    for (const StateCondition& part : condition.all) add(part, parts);
  }

  void add_tasks(const StateCondition& condition, std::vector<Phrase>& parts) const {
    for (const auto& running : condition.running) {
      parts.push_back({kind_of(running.behaviors.size()),
                       describe_running(catalog_, running.task, running.behaviors)});
    }
    for (const TaskId id : condition.stopped) {
      say(parts, fmt::format("{} does not run", task(id)));
    }
    if (condition.only_active) {
      const bool is_one = condition.active.size() == 1;
      const auto name = [this](BehaviorId id) { return behavior(id); };
      say(parts, fmt::format("only {} {} {} active", is_one ? "behavior" : "the behaviors",
                             join(condition.active, ", ", name), is_one ? "is" : "are"));
    } else {
      for (const BehaviorId id : condition.active) {
        say(parts, fmt::format("behavior {} is active", behavior(id)));
      }
    }
    for (const auto& requested : condition.requested) {
      say(parts, fmt::format("{} is requested with priority {} or more", task(requested.task),
                             requested.priority));
    }
  }

  void add_environment(const StateCondition& condition, std::vector<Phrase>& parts) const {
    for (const StateCondition::Situated& situated : condition.variables) {
      std::vector<std::string> values;
      for (const std::uint32_t value : situated.values) {
        values.push_back(printable(catalog_.name_of_value({situated.variable, value})));
      }
      parts.push_back(
          {kind_of(values.size()),
           fmt::format("{} is {}", printable(catalog_.name_of_variable(situated.variable)),
                       list_with_or(values))});
    }
    for (const auto& own : condition.own) {
      say(parts, fmt::format("the situation {} {}", own.available ? "allows" : "forbids",
                             behavior(own.behavior)));
    }
    for (const BehaviorId id : condition.available) {
      say(parts, fmt::format("behavior {} is available", behavior(id)));
    }
    for (const BehaviorId id : condition.faulty) {
      say(parts, fmt::format("behavior {} is faulty", behavior(id)));
    }
    if (condition.none_faulty) say(parts, "no behavior is faulty");
  }

  /// Of what is so in one of some ways.
  static Phrase::Kind kind_of(std::size_t ways) {
    return ways > 1 ? Phrase::Kind::alternatives : Phrase::Kind::single;
  }
  static void say(std::vector<Phrase>& parts, std::string text) {
    parts.push_back({Phrase::Kind::single, std::move(text)});
  }
  [[nodiscard]] std::string task(TaskId id) const { return printable(catalog_.name_of_task(id)); }
  [[nodiscard]] std::string behavior(BehaviorId id) const {
    return printable(catalog_.name_of_behavior(id));
  }

  const CompiledCatalog& catalog_;
};

}  // namespace

std::string describe_condition(const CompiledCatalog& catalog, const StateCondition& condition) {
  return ConditionWords(catalog).describe(condition).text;
}

}  // namespace cbc
