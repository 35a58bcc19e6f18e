#include "verify_case.h"

#include <cstddef>

#include "compiled_text.h"
#include "core/script/condition.h"
#include "generator.h"
#include "random.h"
#include "yaml_text.h"

namespace cbc::plain {

std::vector<const Property*> VerifyCase::properties() const {
  std::vector<const Property*> properties;
  for (const Property& property : question.properties) properties.push_back(&property);
  return properties;
}

VerifyCase generate_verify_case(std::uint64_t seed, bool with_keys) {
  oracle::Random random(seed);
  static const std::vector<std::size_t> sizes = {1, 2, 3, 4, 4, 5, 5, 6, 6, 7, 7, 11};
  VerifyCase sample;
  sample.source = oracle::generate_catalog(random, random.pick(sizes));
  if (random.percent(50)) {
    for (oracle::Task& task : sample.source.tasks) {
      if (task.listed && !task.start_on_request) task.reactive_start = random.percent(60);
    }
  }
  if (with_keys) oracle::add_further_keys(random, sample.source);
  sample.yaml = oracle::catalog_yaml(sample.source, random);
  sample.catalog = oracle::compile_yaml(sample.yaml).value();
  sample.question = generate_question(random, sample.catalog);
  return sample;
}

namespace {

class Writer {
 public:
  explicit Writer(const CompiledCatalog& catalog) : catalog_(catalog) {}

  [[nodiscard]] std::string move(const Move& move) const {
    const auto task = [&] { return std::string(catalog_.task_names[move.subject]); };
    const auto behavior = [&] { return std::string(catalog_.behavior_names[move.subject]); };
    switch (move.kind) {
      case Move::Kind::start:
        return "start " + task() + " " + std::to_string(move.choice);
      case Move::Kind::stop:
        return "stop " + task();
      case Move::Kind::success:
        return "success " + behavior();
      case Move::Kind::failure:
        return "failure " + behavior();
      case Move::Kind::situation_change:
        return "situation change " + behavior();
      case Move::Kind::fault:
        return "fault " + behavior();
      case Move::Kind::repair:
        return "repair " + behavior();
      case Move::Kind::variable:
        return value({move.subject, static_cast<std::uint32_t>(move.choice)});
      case Move::Kind::own:
        return "own " + behavior() + (move.choice != 0 ? " true" : " false");
      case Move::Kind::together:
        return "together " + std::to_string(move.subject) + " " + std::to_string(move.choice);
      case Move::Kind::due:
        return "due";
    }
    return {};
  }

  [[nodiscard]] std::string task(TaskId task) const {
    return std::string(catalog_.name_of_task(task));
  }
  [[nodiscard]] std::string behavior(BehaviorId behavior) const {
    return std::string(catalog_.name_of_behavior(behavior));
  }
  [[nodiscard]] std::string value(VariableValue value) const {
    return std::string(catalog_.name_of_variable(value.variable)) + " = " +
           std::string(catalog_.name_of_value(value));
  }

  [[nodiscard]] std::string part(const SituationPart& part) const {
    std::string text;
    for (const VariableValue& entry : part.variables) text += " " + value(entry);
    for (const SituationPart::Own& entry : part.behaviors) {
      text += " own " + behavior(entry.behavior) + (entry.available ? " true" : " false");
    }
    return text;
  }

  [[nodiscard]] std::string condition(const StateCondition& condition) const {
    return " " + describe_condition(catalog_, condition);
  }

  [[nodiscard]] std::string kinds(const MoveKinds& kinds) const {
    std::string text;
    for (const MoveKindWord& known : move_kind_words) {
      if (kinds.*known.kind) text += " " + std::string(known.word);
    }
    for (const TaskId one : kinds.start_only) text += " start:" + task(one);
    for (const TaskId one : kinds.stop_only) text += " stop:" + task(one);
    return text;
  }

  [[nodiscard]] std::string property(const Property& property) const {
    std::string text = property.name + " " + std::string(name_of(property.kind));
    if (property.task != none) {
      text += " " + task(property.task) + " " + std::to_string(property.priority);
    }
    text += condition(property.condition);
    if (property.when) text += " when" + condition(*property.when);
    if (property.after) text += " after" + condition(*property.after);
    if (property.until) text += " until" + condition(*property.until);
    if (property.within) text += " within " + std::to_string(*property.within);
    if (property.by) text += " by" + kinds(*property.by);
    return text + (property.settled ? " settled\n" : "\n");
  }

  [[nodiscard]] std::string assumptions(const Assumptions& assumptions) const {
    std::string text = "start";
    for (const Assumptions::Start& start : assumptions.start) {
      text += " " + task(start.task) + ":";
      for (const std::int32_t priority : start.priorities) text += " " + std::to_string(priority);
    }
    text += "\nstop";
    for (const TaskId one : assumptions.stop) text += " " + task(one);
    text += assumptions.successes ? "\nsuccesses" : "\nno successes";
    text += assumptions.failures ? ", failures" : ", no failures";
    if (assumptions.most_failed) text += " of " + std::to_string(*assumptions.most_failed);
    if (assumptions.most_suspended) {
      text += ", suspended " + std::to_string(*assumptions.most_suspended);
    }
    text += ", faults " + std::to_string(assumptions.faults);
    if (assumptions.only_listed_fail) text += " only";
    if (!assumptions.only_listed_fail && !assumptions.listed_for_faults.empty()) text += " but";
    for (const BehaviorId one : assumptions.listed_for_faults) text += " " + behavior(one);
    text += "\nchange";
    for (const std::uint32_t variable : assumptions.variables) {
      text += " " + std::string(catalog_.name_of_variable(variable));
    }
    for (const BehaviorId one : assumptions.behaviors) text += " " + behavior(one);
    for (const SituationPart& entry : assumptions.never) text += "\nnever" + part(entry);
    for (const auto& list : assumptions.together) {
      text += "\ntogether";
      for (const std::uint32_t variable : list) {
        text += " " + std::string(catalog_.name_of_variable(variable));
      }
    }
    return text + "\ninitially" + part(assumptions.initially) + "\n";
  }

 private:
  const CompiledCatalog& catalog_;
};

}  // namespace

std::string text_of(const CompiledCatalog& catalog, const std::vector<Move>& script) {
  const Writer writer(catalog);
  std::string text;
  for (const Move& move : script) text += "  " + writer.move(move) + "\n";
  return text;
}

std::string text_of(const VerifyCase& sample) {
  const Writer writer(sample.catalog);
  std::string text = sample.yaml + "--- groups";
  for (const GroupId group : sample.question.groups) text += " " + std::to_string(group);
  text += "\n" + writer.assumptions(sample.question.assumptions);
  for (const Property& property : sample.question.properties) text += writer.property(property);
  return text;
}

std::string text_of(const CompiledCatalog& catalog, const Verdict& verdict) {
  static const char* const results[] = {"proved", "violated", "undecided"};
  return std::string(results[static_cast<std::size_t>(verdict.result)]) +
         (verdict.is_vacuous ? ", vacuously" : "") + (verdict.has_script ? ", by\n" : "\n") +
         text_of(catalog, verdict.script);
}

}  // namespace cbc::plain
