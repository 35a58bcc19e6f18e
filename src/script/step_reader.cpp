#include "script/step_reader.h"

#include <algorithm>
#include <string>
#include <utility>

#include "cbc/event.h"
#include "cbc/rules.h"
#include "script/expectation_reader.h"
#include "script/parameters.h"
#include "script/shapes.h"
#include "text/decimal.h"
#include "text/quote.h"
#include "yaml/duplicates.h"
#include "yaml/values.h"

namespace cbc {
namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

constexpr std::string_view expect = "expect";
constexpr std::string_view verbs[] = {"start", "stop",   "finish", "situation",
                                      "fault", "repair", expect};

// Keys that belong to some verbs only.
struct Detail {
  std::string_view key;
  std::string_view verbs;  ///< for messages
  bool (*belongs_to)(std::string_view verb);
};
constexpr Detail details[] = {
    {"priority", "'start' and 'stop'",
     [](std::string_view verb) { return verb == "start" || verb == "stop"; }},
    {"parameters", "'start'", [](std::string_view verb) { return verb == "start"; }},
    {"cause", "'finish'", [](std::string_view verb) { return verb == "finish"; }},
};

void report_misplaced(const Fields& fields, std::string_view verb, Reporter& reporter) {
  for (const Detail& detail : details) {
    if (fields.find(detail.key) == nullptr || detail.belongs_to(verb)) continue;
    reporter.report_as(Severity::error, rule::unknown_key, fields.range_of(detail.key),
                       quote(detail.key) + " does not belong to " + quote(verb) + ", only to " +
                           std::string(detail.verbs));
  }
}

// The verb of an entry; "wait" if it has a time only; empty after an error.
std::string_view find_verb(const Fields& fields, const Range& range, Reporter& reporter) {
  std::vector<std::string_view> found;
  std::string_view without_value;
  for (const std::string_view verb : verbs) {
    if (fields.find(verb) != nullptr) {
      found.push_back(verb);
    } else if (fields.has(verb)) {
      without_value = verb;
    }
  }
  if (found.size() == 1) return found.front();
  if (found.size() > 1) {
    std::sort(found.begin(), found.end(), [&fields](std::string_view a, std::string_view b) {
      return fields.range_of(a) < fields.range_of(b);
    });
    reporter.report(rule::invalid_value, fields.range_of(found[1]),
                    "an event has one verb, found " + quote(found[0]) + " and " + quote(found[1]),
                    {reporter.note(fields.range_of(found[0]), "the first one is here")});
  } else if (!without_value.empty()) {
    reporter.report(rule::missing_key, fields.range_of(without_value),
                    quote(without_value) + " has no value");
  } else if (fields.has_unknown()) {
    // Probably a misspelt verb; it is reported as such.
  } else if (fields.find("at") != nullptr || fields.find("wait") != nullptr) {
    return "wait";
  } else {
    reporter.report(rule::missing_key, range,
                    "an event needs one of 'start', 'stop', 'finish', 'situation', 'fault', "
                    "'repair', 'expect', 'at' and 'wait'");
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
    read_verb(verb, fields, step, reporter);
  }
  fields.report_unknown(Severity::error);
  return step;
}

void StepReader::resume(Microseconds now, const State& state) {
  clock_ = now;
  const auto& ids = names_.catalog().behavior_ids;
  for (std::uint32_t behavior = 0; behavior < ids.size(); ++behavior) {
    is_available_[behavior] = state.is_available(ids[behavior]);
  }
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

void StepReader::read_verb(std::string_view verb, const Fields& fields, Step& step,
                           Reporter& reporter) {
  if (verb == "wait") {
    step.verb = Verb::wait;
    return;
  }
  const Node& value = *fields.find(verb);
  if (verb == expect) {
    step.expect = read_expectation(value, names_, reporter);
  } else if (verb == "situation") {
    step.verb = Verb::situation;
    step.situation = read_situation(value, reporter);
  } else if (verb == "start" || verb == "stop") {
    step.verb = verb == "start" ? Verb::start : Verb::stop;
    const auto task = names_.find_task(value, verb, reporter);
    step.subject = task.value_or(0);
    if (const Node* priority = fields.find("priority")) {
      step.priority =
          yaml::read_integer(*priority, "priority", step.verb == Verb::start ? 1 : 0, reporter);
    }
    const Node* parameters = fields.find("parameters");
    if (parameters != nullptr && step.verb == Verb::start) {
      step.parameters = read_parameters(*parameters, reporter);
      if (task && step.parameters) parameter_checks_.check(*task, *parameters, reporter);
    }
  } else {
    step.verb = verb == "finish" ? Verb::finish : verb == "fault" ? Verb::fault : Verb::repair;
    const auto behavior = names_.find_behavior(value, verb, reporter);
    step.subject = behavior.value_or(0);
    const Node* cause = fields.find("cause");
    if (cause != nullptr && step.verb == Verb::finish) {
      const auto choice = yaml::read_choice(
          *cause, "cause",
          {name_of(FinishCause::goal_achieved), name_of(FinishCause::time_out),
           name_of(FinishCause::wrong_progress), name_of(FinishCause::situation_change),
           name_of(FinishCause::process_failure), name_of(FinishCause::interrupted)},
          reporter);
      if (choice) step.cause = static_cast<FinishCause>(*choice);
      if (behavior && choice && step.cause == FinishCause::situation_change) {
        check_finish(*behavior, value.range, reporter);
      }
    }
  }
}

void StepReader::check_finish(std::uint32_t behavior, const Range& range, Reporter& reporter) {
  if (!knows_situation_ || !is_available_[behavior]) return;
  const std::string_view name = names_.catalog().behavior_names[behavior];
  reporter.report(rule::still_available, range,
                  "behavior " + quote(name) +
                      " is still available here, so that it can be chosen again at once; say " +
                      quote("situation: {" + std::string(name) + ": false}") + " before");
}

std::vector<Availability> StepReader::read_situation(const Node& node, Reporter& reporter) {
  std::vector<Availability> situation;
  constexpr std::string_view expected = "a mapping of behaviors to true or false";
  if (yaml::read_mapping(node, "situation", expected, reporter) == nullptr) {
    doubt_situation();
    return situation;
  }
  yaml::report_duplicate_keys(node, reporter);
  for (const auto& [key, value] : node.entries) {
    const auto behavior = names_.find_behavior(*key, "situation", reporter);
    const auto available = yaml::read_boolean(*value, key->text, reporter);
    if (!behavior || !available) {
      doubt_situation();
      continue;
    }
    situation.push_back({*behavior, *available});
    is_available_[*behavior] = *available;
  }
  return situation;
}

}  // namespace cbc
