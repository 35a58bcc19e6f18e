#include "core/script/reader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "core/catalog/foreign_file.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/script/expectation.h"
#include "core/script/names.h"
#include "core/script/script.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"
#include "runtime/coordinator/record.h"

namespace cbc::shape {
namespace {

using yaml::Key;
using yaml::Shape;

constexpr Key script_keys[] = {
    {"catalog"}, {"reactive_delay"}, {"timeouts"}, {"situation"}, {"events"}};
constexpr auto event_keys = [] {
  constexpr std::string_view others[] = {"expect", "at", "priority", "parameters", "cause"};
  std::array<Key, scripted_verbs.size() + std::size(others)> keys{};
  std::size_t count = 0;
  for (const VerbForm& form : scripted_verbs) keys[count++].name = form.name;
  for (const std::string_view key : others) keys[count++].name = key;
  return keys;
}();
constexpr Key expectation_keys[] = {{"outcome"},         {"running"},   {"stopped"}, {"active"},
                                    {"active_includes"}, {"suspended"}, {"failed"}};

constexpr Key finished_task_keys[] = {{"task"}};

constexpr const Shape* in_event[] = {&expectation, &finished_task};

}  // namespace

const Shape script{"a script", script_keys};
const Shape event{"an event", event_keys, nullptr, in_event, true};
const Shape expectation{"an expect", expectation_keys, &event};
const Shape finished_task{"a finish", finished_task_keys, &event};

}  // namespace cbc::shape

namespace cbc {
namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

constexpr std::string_view expect = "expect";

/// The keys that say what an entry is: a verb with a subject, or an expectation.
constexpr auto event_words = [] {
  constexpr auto count = std::count_if(
      scripted_verbs.begin(), scripted_verbs.end(),
      [](const VerbForm& form) { return form.subject != VerbForm::SubjectKind::nothing; });
  std::array<std::string_view, count + 1> words;
  std::size_t place = 0;
  for (const VerbForm& form : scripted_verbs) {
    if (form.subject != VerbForm::SubjectKind::nothing) words[place++] = form.name;
  }
  words[place] = expect;
  return words;
}();

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
  std::vector<std::string> verbs;
  for (const VerbForm& form : scripted_verbs) {
    if (form.*belongs) verbs.push_back(quote(form.name));
  }
  return join(verbs, " and ");
}

/// The keys of which an event needs one, for messages.
const std::string& all_event_words() {
  static const std::string words = [] {
    std::string text;
    for (const std::string_view word : event_words) text += quote(word) + ", ";
    return text + "'at' and 'wait'";
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
  const yaml::ChosenKey chosen =
      yaml::choose_key(fields, event_words, "an event must have exactly one verb", reporter);
  if (!chosen.name.empty() || chosen.is_reported) return chosen.name;
  if (fields.has_unknown()) {
    // Probably a misspelt verb; it is reported as such.
  } else if (fields.find("at") != nullptr || fields.find("wait") != nullptr) {
    return name_of(Verb::wait);
  } else if (!chosen.without_value.empty()) {
    reporter.report(rule::missing_key, fields.range_of(chosen.without_value),
                    quote(chosen.without_value) + " has no value");
  } else {
    reporter.report(rule::missing_key, range, "an event needs one of " + all_event_words());
  }
  return {};
}

/// For a text such as "stop DELIVER": what was probably meant. Empty if nothing is known.
std::string suggest_mapping(const Node& node) {
  if (node.kind != Kind::scalar) return {};
  const std::size_t end = node.text.find_first_of(" :");
  if (end == std::string::npos || end + 1 == node.text.size()) return {};
  const std::string_view word = std::string_view(node.text).substr(0, end);
  const std::string_view rest = std::string_view(node.text).substr(end + 1);
  if (word != "at" && !is_scripted_verb(word)) return {};
  return concat("; write ", quote(concat(word, ": ", rest)));
}

}  // namespace

Step StepReader::read(const Node& node, Reporter& reporter) {
  Step step;
  step.range = node.range;
  if (node.kind != Kind::mapping) {
    reporter.report(rule::wrong_type, node.range,
                    "an event must be a mapping ('start: TASK'), found " + yaml::describe(node) +
                        suggest_mapping(node));
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
      subject = parts.verb == Verb::start
                    ? names_.find_requestable(*parts.subject, parts.subject_key, reporter)
                    : names_.find_task(step.is_by_task ? *parts.task : *parts.subject,
                                       parts.subject_key, reporter);
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
    if (subject && step.parameters && checks_parameters_) {
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
  std::optional<Situation> situation = cbc::read_situation(node, names_, reporter);
  if (!situation) {
    doubt_situation();
    return {};
  }
  for (const Availability& entry : situation->availability) {
    is_denied_[entry.behavior] = !entry.available;
  }
  for (const VariableValue value : situation->variables) variables_[value.variable] = value.value;
  return std::move(*situation);
}

namespace {

void read_steps(const Node& list, StepReader& reader, Script& script, Reporter& reporter) {
  for (const Node* item : list.items) script.steps.push_back(reader.read(*item, reporter));
}

/// A mapping that is an event, such as a line of a stream, and not a script. "situation" is a key
/// of both.
bool is_event(const Node& root) {
  const auto has = [&root](const auto& key) { return root.find(key.name) != nullptr; };
  return std::none_of(std::begin(shape::script_keys), std::end(shape::script_keys), has) &&
         std::any_of(scripted_verbs.begin(), scripted_verbs.end(), has);
}

void read_mapping(const Node& root, StepReader& reader, Script& script, Reporter& reporter) {
  Fields fields(root, shape::script, reporter);
  if (const Node* catalog = fields.find("catalog")) {
    // The catalog was loaded before the script is read.
    script.catalog =
        yaml::read_name(*catalog, "catalog", "the path of a catalog", reporter).value_or("");
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

/// Notes requests of tasks that are not meant to be started on request, each task once.
void check_requests(const Script& script, const CompiledCatalog& catalog, Reporter& reporter) {
  std::set<std::uint32_t> noted;
  for (const Step& step : script.steps) {
    if (step.expect || step.verb != Verb::start) continue;
    if (catalog.tasks[catalog.task_ids[step.subject]].start_on_request != 0) continue;
    if (!noted.insert(step.subject).second) continue;
    reporter.report(rule::supporting_request, step.range,
                    concat("task ", quote(catalog.task_names[step.subject]),
                           " has 'start_on_request: FALSE', and is requested here; 'cbc verify' "
                           "requests it only if its assumptions say so"));
  }
}

}  // namespace

const Node* catalog_of_script(const yaml::Document& document) {
  const Node& root = document.root();
  if (root.kind != Kind::mapping) return nullptr;
  const Node* const catalog = root.find("catalog");
  const bool is_name =
      catalog != nullptr && catalog->kind == Kind::scalar && !catalog->text.empty();
  return is_name ? catalog : nullptr;
}

std::optional<Script> read_script(const yaml::Document& document, const CompiledCatalog& catalog,
                                  Severity of_parameters, Diagnostics& diagnostics,
                                  const Snapshot* state, std::vector<NamePlace>* names) {
  Reporter reporter(document.file(), diagnostics);
  StepReader reader(catalog, of_parameters, names);
  if (state != nullptr) {
    State saved(catalog);
    saved.restore(*state);
    reader.resume(state->now, saved);
  }
  Script script;
  script.file = document.file();
  const Node& root = document.root();
  const std::string_view foreign =
      root.find("events") == nullptr ? find_foreign_file(root) : std::string_view();
  if (!foreign.empty()) {
    reporter.report(rule::wrong_type, root.range, describe_foreign_file("event script", foreign));
    return std::nullopt;
  }
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
      if (is_event(root)) {
        reporter.report(rule::wrong_type, root.range,
                        "a script must be a list of events, found one event; one event on each "
                        "line needs --format jsonl");
        break;
      }
      read_mapping(root, reader, script, reporter);
      break;
  }
  if (reporter.errors() > 0) return std::nullopt;
  check_requests(script, catalog, reporter);
  return script;
}

}  // namespace cbc
