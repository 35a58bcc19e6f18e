#include "script/event_log.h"

#include <utility>

#include "cbc/event.h"
#include "cbc/rules.h"
#include "compiled/identity.h"
#include "script/parameters.h"
#include "text/quote.h"
#include "yaml/values.h"

namespace cbc {
namespace {

using yaml::Node;

constexpr std::string_view schema = "cbc.events/1";

/// Reports an absent key.
const Node* require(const Node& object, std::string_view key, Reporter& reporter) {
  const Node* const value = object.find(key);
  if (value == nullptr) {
    reporter.report(rule::missing_key, object.range, "missing key " + quote(key));
  }
  return value;
}

std::string text_of(const Node& object, std::string_view key, Reporter& reporter) {
  const Node* const node = require(object, key, reporter);
  if (node == nullptr) return {};
  return std::string(yaml::read_text(*node, key, "a text", reporter).value_or(""));
}

/// Whether a line, of an event or the last one, has what --stats adds.
bool has_times(const Node& line) {
  const Node* const search = line.find("search");
  return line.find("totals") != nullptr ||
         (search != nullptr && search->find("elapsed_us") != nullptr);
}

}  // namespace

std::optional<EventLog::Header> EventLog::read_header(std::string_view line) {
  Diagnostics diagnostics;
  Reporter reporter({}, diagnostics);
  Header header;
  if (const Node* const root = read_object(line, 1, reporter)) {
    const std::string found = text_of(*root, "schema", reporter);
    if (reporter.errors() == 0 && found != schema) {
      error_ = "its schema is " + quote(found) + ", expected " + quote(schema);
      return std::nullopt;
    }
    const std::string digest = text_of(*root, "digest", reporter);
    const std::string expected = to_hex(identity_of(catalog_));
    if (reporter.errors() == 0 && digest != expected) {
      error_ = "it was made with another catalog, with the digest " + quote(digest) + "; that of " +
               quote(catalog_.file) + " is " + expected;
      return std::nullopt;
    }
    header.catalog = text_of(*root, "catalog", reporter);
    if (const Node* const delay = require(*root, "reactive_delay", reporter)) {
      header.reactive_delay =
          yaml::read_seconds(*delay, "reactive_delay", true, reporter).value_or(1);
    }
    if (const Node* const situation = require(*root, "situation", reporter)) {
      header.situation = read_situation(*situation, reporter);
    }
  }
  if (!is_good(reporter, diagnostics)) return std::nullopt;
  return header;
}

std::optional<EventLog::Entry> EventLog::read_entry(std::string_view line, std::uint32_t number) {
  Diagnostics diagnostics;
  Reporter reporter({}, diagnostics);
  Entry entry;
  if (const Node* const root = read_object(line, number, reporter)) {
    if (has_times(*root)) {
      error_ = "it was made with --stats, and the times in it cannot be repeated";
      return std::nullopt;
    }
    if (root->find("error") == nullptr) entry = read_event(*root, reporter);
  }
  if (!is_good(reporter, diagnostics)) return std::nullopt;
  return entry;
}

const Node* EventLog::read_object(std::string_view line, std::uint32_t number, Reporter& reporter) {
  const Node* const root = json_.read(line, number);
  if (root != nullptr && root->kind == yaml::Kind::mapping) return root;
  reporter.report(rule::wrong_type, {}, "the line is no JSON object, or damaged");
  return nullptr;
}

std::vector<Availability> EventLog::read_situation(const Node& node, Reporter& reporter) {
  std::vector<Availability> situation;
  if (yaml::read_mapping(node, "situation", "an object", reporter) == nullptr) return situation;
  for (const auto& [key, value] : node.entries) {
    const auto behavior = names_.find_behavior(*key, "situation", reporter);
    const auto available = yaml::read_boolean(*value, key->text, reporter);
    if (behavior && available) situation.push_back({*behavior, *available});
  }
  return situation;
}

EventLog::Entry EventLog::read_event(const Node& event, Reporter& reporter) {
  Entry entry;
  entry.is_event = true;
  if (const Node* const time = require(event, "time", reporter)) {
    entry.time = yaml::read_seconds(*time, "time", false, reporter).value_or(0);
  }
  if (text_of(event, "origin", reporter) == name_of(Origin::script)) {
    entry.step = read_step(event, reporter);
    entry.step->range = event.range;
    entry.step->time = entry.time;
  }
  return entry;
}

Step EventLog::read_step(const Node& event, Reporter& reporter) {
  Step step;
  const Node* const verb = require(event, "verb", reporter);
  if (verb == nullptr) return step;
  const auto choice = yaml::read_choice(
      *verb, "verb",
      {name_of(Verb::start), name_of(Verb::stop), name_of(Verb::finish), name_of(Verb::situation),
       name_of(Verb::fault), name_of(Verb::repair), name_of(Verb::wait)},
      reporter);
  if (!choice) return step;
  step.verb = static_cast<Verb>(*choice);
  if (step.verb == Verb::wait) return step;
  if (step.verb == Verb::situation) {
    if (const Node* const situation = require(event, "situation", reporter)) {
      step.situation = read_situation(*situation, reporter);
    }
    return step;
  }
  const Node* const name = require(event, "name", reporter);
  if (name == nullptr) return step;
  if (step.verb == Verb::start || step.verb == Verb::stop) {
    step.subject = names_.find_task(*name, "name", reporter).value_or(0);
    if (const Node* const priority = require(event, "priority", reporter)) {
      step.priority =
          yaml::read_integer(*priority, "priority", step.verb == Verb::start ? 1 : 0, reporter);
    }
    const Node* const parameters = event.find("parameters");
    if (parameters != nullptr) step.parameters = read_parameters(*parameters, reporter);
    return step;
  }
  step.subject = names_.find_behavior(*name, "name", reporter).value_or(0);
  if (step.verb != Verb::finish) return step;
  if (const Node* const cause = require(event, "cause", reporter)) {
    const auto found = yaml::read_choice(
        *cause, "cause",
        {name_of(FinishCause::goal_achieved), name_of(FinishCause::time_out),
         name_of(FinishCause::wrong_progress), name_of(FinishCause::situation_change),
         name_of(FinishCause::process_failure), name_of(FinishCause::interrupted)},
        reporter);
    if (found) step.cause = static_cast<FinishCause>(*found);
  }
  return step;
}

/// Takes up the first error.
bool EventLog::is_good(const Reporter& reporter, const Diagnostics& diagnostics) {
  if (reporter.errors() == 0) return true;
  for (const Diagnostic& finding : diagnostics.all()) {
    if (finding.severity != Severity::error) continue;
    error_ = finding.message;
    break;
  }
  return false;
}

}  // namespace cbc
