#include "script/reader.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/text.h"
#include "catalog/situation.h"
#include "cbc/event.h"
#include "coordinator/record.h"
#include "diagnostic/diagnostic.h"
#include "diagnostic/rules.h"
#include "script/script.h"
#include "yaml/values.h"

namespace cbc::shape {
namespace {

using yaml::Key;
using yaml::Shape;

constexpr Key script_keys[] = {
    {"catalog"}, {"reactive_delay"}, {"timeouts"}, {"situation"}, {"events"}};
constexpr auto event_keys = [] {
  constexpr std::string_view others[] = {"expect", "at", "priority", "parameters", "cause"};
  std::array<Key, verb_forms.size() + std::size(others)> keys{};
  std::size_t count = 0;
  for (const VerbForm& form : verb_forms) keys[count++].name = form.name;
  for (const std::string_view key : others) keys[count++].name = key;
  return keys;
}();
constexpr Key expectation_keys[] = {{"outcome"}, {"running"}, {"stopped"}, {"active"}};

constexpr Key finished_task_keys[] = {{"task"}};

constexpr const Shape* in_event[] = {&expectation, &finished_task};

}  // namespace

const Shape script{"a script", script_keys};
const Shape event{"an event", event_keys, nullptr, in_event};
const Shape expectation{"an expect", expectation_keys, &event};
const Shape finished_task{"a finish", finished_task_keys, &event};

}  // namespace cbc::shape

namespace cbc {
namespace {

Suggestions& suggestions_from(const Texts& names, std::optional<Suggestions>& made) {
  if (!made) {
    std::vector<std::string_view> all;
    all.reserve(names.size());
    // NOLINTNEXTLINE(modernize-loop-convert): these texts have no iterators
    for (std::size_t place = 0; place < names.size(); ++place) all.push_back(names[place]);
    made.emplace(std::move(all));
  }
  return *made;
}

// The name is unknown as a `kind`, but may be known as another.
std::string describe_unknown(std::string_view name, std::string_view kind, bool is_other,
                             std::string_view other, Suggestions& suggestions,
                             const yaml::Node* beside) {
  std::string message = "there is no " + std::string(kind) + " " + quote(name);
  if (is_other) message += ": it is a " + std::string(other);
  const auto is_taken = [beside](std::string_view known) {
    return beside != nullptr && yaml::stands_in(*beside, known);
  };
  message += did_you_mean(suggestions.nearest(name, is_taken));
  return message;
}

}  // namespace

std::optional<std::uint32_t> NameIndex::find_task(const yaml::Node& node, std::string_view what,
                                                  Reporter& reporter, const yaml::Node* beside) {
  const auto name = yaml::read_name(node, what, "the name of a task", reporter);
  if (!name) return std::nullopt;
  const auto found = catalog_.find_task(*name);
  if (!found) {
    reporter.report(
        rule::undefined_task, node.range,
        describe_unknown(*name, "task", catalog_.find_behavior(*name).has_value(), "behavior",
                         suggestions_from(catalog_.task_names, tasks_), beside));
  }
  return found;
}

std::optional<std::uint32_t> NameIndex::find_behavior(const yaml::Node& node, std::string_view what,
                                                      Reporter& reporter,
                                                      const yaml::Node* beside) {
  const auto name = yaml::read_name(node, what, "the name of a behavior", reporter);
  if (!name) return std::nullopt;
  const auto found = catalog_.find_behavior(*name);
  if (found) return found;
  const bool is_task = catalog_.find_task(*name).has_value();
  std::string message =
      is_task && what == cbc::name_of(Verb::finish)
          ? concat("there is no behavior ", quote(*name), ": it is a task; write ",
                   quote(concat("finish: {task: ", *name, "}")),
                   " for the behavior that performs it")
          : describe_unknown(*name, "behavior", is_task, "task",
                             suggestions_from(catalog_.behavior_names, behaviors_), beside);
  reporter.report(rule::undefined_behavior, node.range, std::move(message));
  return std::nullopt;
}

std::optional<NameIndex::Part> NameIndex::find_part(const yaml::Node& node, Reporter& reporter,
                                                    const yaml::Node* beside) {
  const auto name =
      yaml::read_name(node, "situation", "the name of a behavior or a variable", reporter);
  if (!name) return std::nullopt;
  if (const auto variable = catalog_.find_variable(*name)) return Part{true, *variable};
  if (const auto behavior = catalog_.find_behavior(*name)) return Part{false, *behavior};
  if (!parts_) {
    std::vector<std::string_view> names;
    for (const std::string_view behavior : catalog_.behavior_names) names.push_back(behavior);
    for (std::uint32_t variable = 0; variable < catalog_.variables.size(); ++variable) {
      names.push_back(catalog_.name_of_variable(variable));
    }
    parts_.emplace(std::move(names));
  }
  const bool has_variables = !catalog_.variables.empty();
  reporter.report(
      has_variables ? rule::undeclared_situation : rule::undefined_behavior, node.range,
      describe_unknown(*name, has_variables ? "behavior or situation variable" : "behavior",
                       catalog_.find_task(*name).has_value(), "task", *parts_, beside));
  return std::nullopt;
}

namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

template <typename Enum>
std::optional<Enum> read_word(const Node& node, std::string_view what, Reporter& reporter) {
  const auto place = yaml::read_choice(node, what, words_of<Enum>(), reporter);
  return place ? std::optional(static_cast<Enum>(*place)) : std::nullopt;
}

class ExpectationReader {
 public:
  ExpectationReader(NameIndex& names, Reporter& reporter) : names_(names), reporter_(reporter) {}

  Expectation read(const Node& node) && {
    if (yaml::read_mapping(node, "expect", "a mapping", reporter_) == nullptr) return {};
    yaml::Fields fields(node, shape::expectation, reporter_);
    if (const Node* outcome = fields.find("outcome")) read_outcome(*outcome);
    if (const Node* running = fields.find("running")) read_running(*running);
    if (const Node* stopped = fields.find("stopped")) read_stopped(*stopped);
    if (const Node* active = fields.find("active")) read_active(*active);
    fields.report_unknown(yaml::UnknownKeys::refused);
    return std::move(out_);
  }

 private:
  void read_outcome(const Node& node) {
    out_.outcome = read_word<Outcome>(node, "outcome", reporter_);
  }

  void read_running(const Node& node) {
    if (yaml::read_mapping(node, "running", "a mapping of tasks to behaviors or 'any'",
                           reporter_) == nullptr) {
      return;
    }
    yaml::report_duplicate_keys(node, reporter_);
    for (const auto& [key, value] : node.entries) {
      Expectation::Running entry;
      const auto task = names_.find_task(*key, "running", reporter_, &node);
      if (value->kind != Kind::scalar) {
        yaml::report_wrong_type(*value, key->text, "a behavior or 'any'", reporter_);
      } else if (value->text != "any") {
        entry.behavior = names_.find_behavior(*value, key->text, reporter_);
      }
      if (task) running_at_.try_emplace(*task, key->range);
      if (task && entry.behavior) check_performs(*entry.behavior, *task, value->range);
      entry.task = task.value_or(0);
      out_.running.push_back(entry);
    }
  }

  void check_performs(std::uint32_t behavior, std::uint32_t task, const Range& range) {
    const CompiledCatalog& catalog = names_.catalog();
    std::vector<std::uint32_t> performed;
    for (const ValueId value : catalog.performs[catalog.behavior_ids[behavior]]) {
      performed.push_back(catalog.tasks[catalog.task_of(value)].catalog_index);
    }
    if (std::find(performed.begin(), performed.end(), task) != performed.end()) return;
    const std::uint32_t first = *std::min_element(performed.begin(), performed.end());
    std::string performs = quote(catalog.task_names[first]);
    if (performed.size() > 1) performs += " and " + std::to_string(performed.size() - 1) + " more";
    reporter_.report(rule::impossible_expectation, range,
                     "this can never hold: behavior " + quote(catalog.behavior_names[behavior]) +
                         " does not perform task " + quote(catalog.task_names[task]) +
                         ", it performs " + performs);
  }

  void read_stopped(const Node& node) {
    if (yaml::read_list(node, "stopped", "a list of tasks", reporter_) == nullptr) return;
    for (const Node* item : node.items) {
      const auto task = names_.find_task(*item, "stopped", reporter_, &node);
      out_.stopped.push_back(task.value_or(0));
      if (!task) continue;
      const auto running = running_at_.find(*task);
      if (running == running_at_.end()) continue;
      reporter_.report(
          rule::impossible_expectation, item->range,
          "this can never hold: task " + quote(item->text) + " is also expected to run",
          {reporter_.note(running->second, "expected to run here")});
    }
  }

  void read_active(const Node& node) {
    if (yaml::read_list(node, "active", "a list of behaviors", reporter_) == nullptr) return;
    auto& behaviors = out_.active.emplace();
    for (const Node* item : node.items) {
      behaviors.push_back(names_.find_behavior(*item, "active", reporter_, &node).value_or(0));
    }
  }

  NameIndex& names_;
  Reporter& reporter_;
  Expectation out_;
  std::unordered_map<std::uint32_t, Range> running_at_;  ///< by task
};

}  // namespace

Expectation read_expectation(const Node& node, NameIndex& names, Reporter& reporter) {
  return ExpectationReader(names, reporter).read(node);
}

namespace {

constexpr std::string_view expect = "expect";

/// A key that belongs to some verbs only.
struct Detail {
  std::string_view key;
  bool VerbForm::*belongs;
};
constexpr Detail details[] = {{"priority", &VerbForm::has_priority},
                              {"parameters", &VerbForm::has_parameters},
                              {"cause", &VerbForm::has_cause}};

/// "'start' and 'stop'"
std::string list_verbs(bool VerbForm::*belongs) {
  std::string text;
  for (const VerbForm& form : verb_forms) {
    if (form.*belongs) text += (text.empty() ? "" : " and ") + quote(form.name);
  }
  return text;
}

/// The keys of which an event needs one, for messages.
const std::string& all_event_words() {
  static const std::string words = [] {
    std::string text;
    for (const VerbForm& form : verb_forms) {
      if (form.subject != VerbForm::SubjectKind::nothing) text += quote(form.name) + ", ";
    }
    return text + "'expect', 'at' and 'wait'";
  }();
  return words;
}

void report_misplaced(const Fields& fields, std::string_view verb, Reporter& reporter) {
  const std::optional<Verb> known = find_word<Verb>(verb);
  for (const Detail& detail : details) {
    if (fields.find(detail.key) == nullptr) continue;
    if (known && form_of(*known).*detail.belongs) continue;
    reporter.report_as({Severity::error, true}, rule::unknown_key, fields.range_of(detail.key),
                       quote(detail.key) + " does not belong to " + quote(verb) + ", only to " +
                           list_verbs(detail.belongs));
  }
}

// The verb of an entry; "wait" if it only has a time; empty after an error.
std::string_view find_verb(const Fields& fields, const Range& range, Reporter& reporter) {
  std::vector<std::string_view> found;
  std::string_view without_value;
  const auto look_for = [&](std::string_view verb) {
    if (fields.find(verb) != nullptr) {
      found.push_back(verb);
    } else if (fields.has(verb)) {
      without_value = verb;
    }
  };
  for (const VerbForm& form : verb_forms) {
    if (form.subject != VerbForm::SubjectKind::nothing) look_for(form.name);
  }
  look_for(expect);
  if (found.size() == 1) return found.front();
  if (found.size() > 1) {
    std::sort(found.begin(), found.end(), [&fields](std::string_view a, std::string_view b) {
      return fields.range_of(a) < fields.range_of(b);
    });
    reporter.report(
        rule::invalid_value, fields.range_of(found[1]),
        "an event must have exactly one verb, found " + quote(found[0]) + " and " + quote(found[1]),
        {reporter.note(fields.range_of(found[0]), "the first one is here")});
  } else if (fields.has_unknown()) {
    // Probably a misspelt verb; it is reported as such.
  } else if (fields.find("at") != nullptr || fields.find("wait") != nullptr) {
    return name_of(Verb::wait);
  } else if (!without_value.empty()) {
    reporter.report(rule::missing_key, fields.range_of(without_value),
                    quote(without_value) + " has no value");
  } else {
    reporter.report(rule::missing_key, range, "an event needs one of " + all_event_words());
  }
  return {};
}

}  // namespace

Step StepReader::read(const Node& node, Reporter& reporter) {
  Step step;
  step.range = node.range;
  if (node.kind != Kind::mapping) {
    reporter.report(rule::wrong_type, node.range,
                    "an event must be a mapping ('start: TASK'), found " + yaml::describe(node));
    return step;
  }
  Fields fields(node, shape::event, reporter);
  read_time(fields, step, reporter);
  const std::string_view verb = find_verb(fields, node.range, reporter);
  if (verb.empty()) {
    doubt_situation();
  } else {
    report_misplaced(fields, verb, reporter);
    if (verb == expect) {
      step.expect = read_expectation(*fields.find(expect), names_, reporter);
    } else {
      EventParts parts{*find_word<Verb>(verb),  verb,
                       fields.find(verb),       nullptr,
                       fields.find("priority"), fields.find("parameters"),
                       fields.find("cause")};
      if (parts.verb == Verb::finish && parts.subject->kind == Kind::mapping) {
        Fields of_finish(*parts.subject, shape::finished_task, reporter);
        parts.task = of_finish.require("task", parts.subject->range);
        of_finish.report_unknown(yaml::UnknownKeys::refused);
        parts.subject = nullptr;
      }
      read_parts(parts, step, reporter);
    }
  }
  fields.report_unknown(yaml::UnknownKeys::refused);
  return step;
}

void StepReader::resume(Microseconds now, const State& state) {
  clock_ = now;
  const auto& ids = names_.catalog().behavior_ids;
  for (std::uint32_t behavior = 0; behavior < ids.size(); ++behavior) {
    is_denied_[behavior] = state.is_denied(ids[behavior]);
  }
  variables_ = state.variables();
  knows_situation_ = true;
}

void StepReader::read_time(const Fields& fields, Step& step, Reporter& reporter) {
  const Node* at = fields.find("at");
  const Node* wait = fields.find("wait");
  if (at != nullptr && wait != nullptr) {
    const bool at_first = fields.range_of("at") < fields.range_of("wait");
    reporter.report(rule::invalid_value, fields.range_of(at_first ? "wait" : "at"),
                    "'at' and 'wait' are both given in an event",
                    {reporter.note(fields.range_of(at_first ? "at" : "wait"), "first given here")});
    return;
  }
  if (at != nullptr) {
    const auto time = yaml::read_seconds(*at, "at", false, reporter);
    if (!time) return;
    if (*time < clock_) {
      reporter.report(rule::time_order, at->range,
                      "time goes back to " + format_decimal(*time, 6) +
                          " s: the event before is at " + format_decimal(clock_, 6) + " s");
      return;
    }
    clock_ = *time;
  } else if (wait != nullptr) {
    const auto duration = yaml::read_seconds(*wait, "wait", false, reporter);
    if (!duration) return;
    if (*duration > longest_time - clock_) {
      reporter.report(rule::invalid_value, wait->range,
                      "after this wait it is later than " + format_decimal(longest_time, 6) +
                          " s, the end of time");
      return;
    }
    clock_ += *duration;
  } else {
    return;
  }
  step.time = clock_;
}

void StepReader::read_parts(const EventParts& parts, Step& step, Reporter& reporter) {
  step.verb = parts.verb;
  const VerbForm& form = form_of(parts.verb);
  step.is_by_task = parts.task != nullptr;
  if (parts.subject == nullptr && !step.is_by_task) return;
  std::optional<std::uint32_t> subject;
  switch (step.is_by_task ? VerbForm::SubjectKind::task : form.subject) {
    case VerbForm::SubjectKind::nothing:
      return;
    case VerbForm::SubjectKind::situation:
      step.situation = read_situation(*parts.subject, reporter);
      return;
    case VerbForm::SubjectKind::task:
      subject = names_.find_task(step.is_by_task ? *parts.task : *parts.subject, parts.subject_key,
                                 reporter);
      break;
    case VerbForm::SubjectKind::behavior:
      subject = names_.find_behavior(*parts.subject, parts.subject_key, reporter);
      break;
  }
  step.subject = subject.value_or(0);
  if (form.has_priority && parts.priority != nullptr) {
    step.priority = yaml::read_integer(*parts.priority, "priority", form.lowest_priority, reporter);
  }
  if (form.has_parameters && parts.parameters != nullptr) {
    step.parameters = read_parameters(*parts.parameters, reporter);
    if (subject && step.parameters) {
      parameter_checks_.check(*subject, *parts.parameters, reporter);
    }
  }
  if (form.has_cause && parts.cause != nullptr) {
    const auto cause = read_word<FinishCause>(*parts.cause, "cause", reporter);
    if (cause) step.cause = *cause;
    if (subject && cause == FinishCause::situation_change) {
      const Node& name = step.is_by_task ? *parts.task : *parts.subject;
      check_finish(*subject, step.is_by_task, name.range, reporter);
    }
  }
}

/// Checks that the situation rules out a behavior that it finishes. Of a task it is not known which
/// behavior performs it, so there is a finding only if all of them are available.
void StepReader::check_finish(std::uint32_t subject, bool is_task, const Range& range,
                              Reporter& reporter) {
  if (!knows_situation_) return;
  const CompiledCatalog& catalog = names_.catalog();
  std::vector<BehaviorId> behaviors;
  if (!is_task) {
    behaviors.push_back(catalog.behavior_ids[subject]);
  } else {
    for (const Value& value : catalog.values[catalog.task_ids[subject]]) {
      behaviors.push_back(value.behavior);
    }
  }
  const bool are_available =
      std::all_of(behaviors.begin(), behaviors.end(), [&](BehaviorId behavior) {
        return !is_denied_[catalog.behaviors[behavior].catalog_index] &&
               !catalog.find_misfit(behavior, variables_);
      });
  if (behaviors.empty() || !are_available) return;
  std::string message =
      behaviors.size() > 1
          ? concat("every behavior that performs task ", quote(catalog.task_names[subject]), " is")
          : concat("behavior ", quote(catalog.name_of_behavior(behaviors.front())),
                   is_task
                       ? concat(", which performs task ", quote(catalog.task_names[subject]), ",")
                       : "",
                   " is");
  message += " still available here, so that it can be chosen again at once; ";
  if (behaviors.size() > 1) {
    message += "add an event 'situation' before it that rules out the one that is active";
  } else if (const auto value = find_unfit_value(behaviors.front())) {
    message += concat("write ",
                      quote(concat("situation: {", catalog.name_of_variable(value->variable), ": ",
                                   catalog.name_of_value(*value), "}")),
                      " in its place: the behavior then finishes by itself");
  } else {
    message += concat(
        "add ",
        quote(concat("situation: {", catalog.name_of_behavior(behaviors.front()), ": false}")),
        " before it");
  }
  reporter.report(rule::still_available, range, std::move(message));
}

/// A value of a situation variable in which a behavior does not fit. Nothing if it always fits.
std::optional<VariableValue> StepReader::find_unfit_value(BehaviorId behavior) const {
  const CompiledCatalog& catalog = names_.catalog();
  const std::span<const FittingValue> fitting = catalog.fitting_values_of(behavior);
  for (const FittingValue& named : fitting) {
    for (std::uint32_t value = 0; value < catalog.variables[named.variable].value_count; ++value) {
      const bool fits = std::find(fitting.begin(), fitting.end(),
                                  FittingValue{behavior, named.variable, value}) != fitting.end();
      if (!fits) return VariableValue{named.variable, value};
    }
  }
  return std::nullopt;
}

Situation StepReader::read_situation(const Node& node, Reporter& reporter) {
  Situation situation;
  constexpr std::string_view expected =
      "a mapping of behaviors to true or false, or of situation variables to values";
  if (yaml::read_mapping(node, "situation", expected, reporter) == nullptr) {
    doubt_situation();
    return situation;
  }
  yaml::report_duplicate_keys(node, reporter);
  for (const auto& [key, value] : node.entries) {
    if (value->kind == Kind::null) continue;
    const auto part = names_.find_part(*key, reporter, &node);
    if (part && part->is_variable) {
      read_value(part->place, *value, situation, reporter);
      continue;
    }
    // The value of an unknown name may be one of a variable, which the catalog lacks.
    const auto available = part ? yaml::read_boolean(*value, key->text, reporter) : std::nullopt;
    if (!available) {
      doubt_situation();
      continue;
    }
    situation.availability.push_back({part->place, *available});
    is_denied_[part->place] = !*available;
  }
  return situation;
}

void StepReader::read_value(std::uint32_t variable, const Node& node, Situation& situation,
                            Reporter& reporter) {
  const CompiledCatalog& catalog = names_.catalog();
  const auto text = value_text(node, catalog.variables[variable].is_boolean != 0);
  const auto value = text ? catalog.find_value(variable, *text) : std::nullopt;
  if (value) {
    situation.variables.push_back({variable, *value});
    variables_[variable] = *value;
    return;
  }
  doubt_situation();
  std::vector<std::string_view> values;
  for (std::uint32_t place = 0; place < catalog.variables[variable].value_count; ++place) {
    values.push_back(catalog.name_of_value({variable, place}));
  }
  report_unknown_value(node, catalog.name_of_variable(variable), values, reporter);
}

namespace {

void read_steps(const Node& list, StepReader& reader, Script& script, Reporter& reporter) {
  for (const Node* item : list.items) script.steps.push_back(reader.read(*item, reporter));
}

void read_mapping(const Node& root, StepReader& reader, Script& script, Reporter& reporter) {
  Fields fields(root, shape::script, reporter);
  if (const Node* catalog = fields.find("catalog")) {
    // The name is used before the script is read; here it is only checked.
    static_cast<void>(yaml::read_name(*catalog, "catalog", "the path of a catalog", reporter));
  }
  if (const Node* delay = fields.find("reactive_delay")) {
    if (const auto value = yaml::read_seconds(*delay, "reactive_delay", true, reporter)) {
      script.reactive_delay = *value;
    }
  }
  if (const Node* timeouts = fields.find("timeouts")) {
    script.timeouts = yaml::read_boolean(*timeouts, "timeouts", reporter).value_or(true);
  }
  if (const Node* situation = fields.find("situation")) {
    script.situation = reader.read_situation(*situation, reporter);
  } else if (fields.has_unknown()) {
    reader.doubt_situation();  // it may be misspelt
  }
  const Node* events = fields.require("events", root.range);
  if (events != nullptr &&
      yaml::read_list(*events, "events", "a list of events", reporter) != nullptr) {
    read_steps(*events, reader, script, reporter);
  }
  fields.report_unknown(yaml::UnknownKeys::refused);
}

}  // namespace

std::optional<std::string> catalog_of_script(const yaml::Document& document) {
  const Node& root = document.root();
  if (root.kind != Kind::mapping) return std::nullopt;
  const Node* catalog = root.find("catalog");
  if (catalog == nullptr || catalog->kind != Kind::scalar || catalog->text.empty()) {
    return std::nullopt;
  }
  return catalog->text;
}

std::optional<Script> read_script(const yaml::Document& document, const CompiledCatalog& catalog,
                                  Severity of_parameters, Diagnostics& diagnostics,
                                  const Snapshot* state) {
  Reporter reporter(document.file(), diagnostics);
  StepReader reader(catalog, of_parameters);
  if (state != nullptr) {
    State saved(catalog);
    saved.restore(*state);
    reader.resume(state->now, saved);
  }
  Script script;
  script.file = document.file();
  const Node& root = document.root();
  switch (root.kind) {
    case Kind::null:
      reporter.report(rule::missing_key, root.range, "missing key 'events': the script is empty");
      break;
    case Kind::scalar:
      reporter.report(rule::wrong_type, root.range,
                      "a script must be a list of events, or a mapping with the key 'events', "
                      "found " +
                          yaml::describe(root));
      break;
    case Kind::sequence:
      read_steps(root, reader, script, reporter);
      break;
    case Kind::mapping:
      read_mapping(root, reader, script, reporter);
      break;
  }
  if (reporter.errors() > 0) return std::nullopt;
  return script;
}

}  // namespace cbc
