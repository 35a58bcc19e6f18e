#include "core/script/event_lines.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "cbc/event.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/script/reader.h"
#include "core/support/json.h"
#include "core/yaml/document.h"
#include "core/yaml/json_value.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"
#include "runtime/coordinator/record.h"

namespace cbc {

EventLines::Reading EventLines::read(std::string_view line, std::uint32_t number) {
  Reading reading;
  if (line.ends_with('\r')) line.remove_suffix(1);  // a line end of Windows
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos || line[begin] == '#') return reading;

  Diagnostics diagnostics;
  std::unique_ptr<const yaml::Document> document;
  const yaml::Node* node = json_.read(line, number);
  if (node == nullptr || json_.has_merge_key()) {
    node = nullptr;
    document = yaml::parse(line, {}, diagnostics);
    if (document != nullptr) node = &document->root();
  }
  if (node != nullptr) {
    Reporter reporter({}, diagnostics);
    reading.step = reader_.read(*node, reporter);
    reading.step->range = {{number, 1}, {number, 1}};
  }
  for (const Diagnostic& finding : diagnostics.all()) {
    if (finding.severity == Severity::error) {
      reading.error += (reading.error.empty() ? "" : "; ") + finding.message;
    } else {
      reading.warnings.push_back(finding.message);
    }
  }
  if (!reading.error.empty()) reading.step.reset();
  return reading;
}

namespace {

using yaml::Node;

/// Reports a missing key.
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

/// Whether a line (an event or the last one) has what --stats adds.
bool has_times(const Node& line) {
  const Node* const search = line.find("search");
  return line.find("totals") != nullptr ||
         (search != nullptr && search->find("elapsed_us") != nullptr);
}

}  // namespace

bool is_log(std::string_view text) {
  return utf8::without_byte_order_mark(text).starts_with(
      concat(R"({"schema":")", events_schema, "\""));
}

std::optional<EventLog::Header> EventLog::read_header(std::string_view line) {
  Diagnostics diagnostics;
  Reporter reporter({}, diagnostics);
  Header header;
  if (const Node* const root = read_object(line, 1, reporter)) {
    const std::string found = text_of(*root, "schema", reporter);
    if (reporter.errors() == 0 && found != events_schema) {
      error_ = "its schema is " + quote(found) + ", expected " + quote(events_schema);
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
    if (const Node* const timeouts = root->find("timeouts")) {
      header.timeouts = yaml::read_boolean(*timeouts, "timeouts", reporter).value_or(true);
    }
    if (const Node* const clock = root->find("clock")) {
      constexpr std::array<std::string_view, 2> clocks = {"events", "real"};
      if (const auto choice = yaml::read_choice(*clock, "clock", clocks, reporter)) {
        header.clock = clocks[*choice];
      }
    }
    if (const Node* const situation = require(*root, "situation", reporter)) {
      header.situation = reader_.read_situation(*situation, reporter);
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
  reporter.report(rule::wrong_type, {},
                  root == nullptr ? json_.fault() : "it is not a JSON object");
  return nullptr;
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
  const std::string name = text_of(event, "verb", reporter);
  const std::optional<Verb> verb = find_word<Verb>(name);
  if (!verb) {
    reporter.report(rule::invalid_value, event.range, "there is no verb " + quote(name));
    return step;
  }
  const VerbForm& form = form_of(*verb);
  EventParts parts;
  parts.verb = *verb;
  if (form.subject != VerbForm::SubjectKind::nothing) {
    const bool is_name = form.subject != VerbForm::SubjectKind::situation;
    parts.subject_key = is_name ? "name" : "situation";
    parts.task = event.find("task");
    if (parts.task == nullptr) parts.subject = require(event, parts.subject_key, reporter);
  }
  if (form.has_priority) parts.priority = require(event, "priority", reporter);
  if (form.has_parameters) parts.parameters = event.find("parameters");
  if (form.has_cause) parts.cause = require(event, "cause", reporter);
  reader_.read_parts(parts, step, reporter);
  return step;
}

/// Keeps the first error.
bool EventLog::is_good(const Reporter& reporter, const Diagnostics& diagnostics) {
  if (reporter.errors() == 0) return true;
  for (const Diagnostic& finding : diagnostics.all()) {
    if (finding.severity != Severity::error) continue;
    error_ = finding.message;
    break;
  }
  return false;
}

namespace {

using yaml::JsonFault;
using yaml::JsonValue;

constexpr std::string_view state_schema = "cbc.state/1";

class StateReader {
 public:
  StateReader(const Node& root, const CompiledCatalog& catalog) : root_(root), catalog_(catalog) {}

  [[nodiscard]] Snapshot read() {
    if (const std::string schema = root_["schema"].text(); schema != state_schema) {
      throw JsonFault("its schema is " + quote(schema) + ", expected " + quote(state_schema));
    }
    const std::string digest = root_["digest"].text();
    if (const std::string expected = to_hex(identity_of(catalog_)); digest != expected) {
      throw JsonFault("it is the state of another catalog, with the digest " + quote(digest) +
                      "; that of " + quote(catalog_.file) + " is " + expected);
    }
    out_.now = root_["time_us"].integer<Microseconds>();
    out_.events = root_["events"].integer<std::uint64_t>();
    out_.reactive_delay = root_["reactive_delay_us"].integer<Microseconds>();
    if (const auto timeouts = root_.find("timeouts")) out_.timeouts = timeouts->truth();
    if (const JsonValue outcome = root_["outcome"]; !outcome.is_null()) {
      out_.outcome = find_word<Outcome>(outcome.text());
      if (!out_.outcome) throw JsonFault("there is no outcome " + quote(outcome.text()));
    }
    for (const JsonValue& entry : root_["running"].items()) read_task(entry);
    for (const JsonValue& time : root_["active"].members()) {
      out_.active.emplace_back(behavior(time.name()), time.integer<Microseconds>());
    }
    for (const JsonValue& name : root_["unavailable"].items()) {
      out_.denied.push_back(behavior(name.text()));
    }
    out_.variables.assign(catalog_.variables.size(), none);
    if (const auto variables = root_.find("variables")) {
      for (const JsonValue& value : variables->members()) read_variable(value);
    }
    for (std::uint32_t variable = 0; variable < out_.variables.size(); ++variable) {
      if (out_.variables[variable] != none) continue;
      throw JsonFault("situation variable " + quote(catalog_.name_of_variable(variable)) +
                      " has no value");
    }
    for (const JsonValue& name : root_["faulty"].items()) {
      out_.faulty.push_back(behavior(name.text()));
    }
    for (const JsonValue& due : root_["queue"].members()) {
      out_.queue.emplace_back(task(due.name()), due.integer<Microseconds>());
    }
    if (const auto waiting = root_.find("waiting")) {  // states of cbc 0.1 have none
      for (const JsonValue& name : waiting->items()) out_.waiting.push_back(task(name.text()));
    }
    if (const auto problem = find_inconsistency(catalog_, out_)) throw JsonFault(*problem);
    return std::move(out_);
  }

 private:
  void read_task(const JsonValue& entry) {
    Snapshot::RunningTask& running = out_.running.emplace_back();
    running.task = task(entry["task"].text());
    running.value_index = value_index(running.task, behavior(entry["behavior"].text()));
    running.since = entry["since_us"].integer<Microseconds>();
    running.waits_for_timeout = entry["waits_for_timeout"].truth();
    const JsonValue request = entry["request"];
    if (request.is_null()) return;
    running.request =
        Request{request["priority"].integer<std::int32_t>(),
                request["event"].integer<std::uint64_t>(), request["parameters"].text()};
  }

  void read_variable(const JsonValue& value) {
    const auto variable = catalog_.find_variable(value.name());
    if (!variable) throw JsonFault("there is no situation variable " + quote(value.name()));
    const bool is_boolean = catalog_.variables[*variable].is_boolean != 0;
    const std::string text = !is_boolean ? value.text() : value.truth() ? "true" : "false";
    const auto place = catalog_.find_value(*variable, text);
    if (!place) {
      throw JsonFault("situation variable " + quote(value.name()) + " has no value " + quote(text));
    }
    if (out_.variables[*variable] != none) {
      throw JsonFault("situation variable " + quote(value.name()) + " has two values");
    }
    out_.variables[*variable] = *place;
  }

  [[nodiscard]] TaskId task(std::string_view name) const {
    if (const auto found = catalog_.find_task(name)) return catalog_.task_ids[*found];
    throw JsonFault("there is no task " + quote(name));
  }
  [[nodiscard]] BehaviorId behavior(std::string_view name) const {
    if (const auto found = catalog_.find_behavior(name)) return catalog_.behavior_ids[*found];
    throw JsonFault("there is no behavior " + quote(name));
  }
  [[nodiscard]] std::uint32_t value_index(TaskId task, BehaviorId behavior) const {
    const auto values = catalog_.values[task];
    for (std::uint32_t index = 0; index < values.size(); ++index) {
      if (values[index].behavior == behavior) return index;
    }
    throw JsonFault("task " + quote(catalog_.name_of_task(task)) + " runs with " +
                    quote(catalog_.name_of_behavior(behavior)) + ", which does not perform it");
  }

  const JsonValue root_;
  const CompiledCatalog& catalog_;
  Snapshot out_;
};

void write_running(JsonWriter& json, const CompiledCatalog& catalog,
                   const Snapshot::RunningTask& entry) {
  json.open('{');
  const BehaviorId behavior = catalog.values[entry.task][entry.value_index].behavior;
  json.write_members({{"task", catalog.name_of_task(entry.task)},
                      {"behavior", catalog.name_of_behavior(behavior)},
                      {"since_us", entry.since},
                      {"waits_for_timeout", entry.waits_for_timeout}});
  if (entry.request) {
    json.write_object("request", {{"priority", entry.request->priority},
                                  {"event", entry.request->event},
                                  {"parameters", entry.request->parameters}});
  } else {
    json.write("request", nullptr);
  }
  json.close('}');
}

}  // namespace

void write_value(JsonWriter& json, const CompiledCatalog& catalog, VariableValue value) {
  const std::string_view name = catalog.name_of_variable(value.variable);
  if (catalog.variables[value.variable].is_boolean != 0) {
    json.write(name, value.value == 0);
  } else {
    json.write(name, catalog.name_of_value(value));
  }
}

void write_situation(JsonWriter& json, const CompiledCatalog& catalog, const Situation& situation) {
  json.open("situation", '{');
  for (const Availability& entry : situation.availability) {
    json.write(catalog.behavior_names[entry.behavior], entry.available);
  }
  for (const VariableValue value : situation.variables) write_value(json, catalog, value);
  json.close('}');
}

void write_variables(JsonWriter& json, const CompiledCatalog& catalog, std::string_view key,
                     std::span<const std::uint32_t> values) {
  json.open(key, '{');
  for (std::uint32_t variable = 0; variable < values.size(); ++variable) {
    write_value(json, catalog, {variable, values[variable]});
  }
  json.close('}');
}

std::string write_state(const CompiledCatalog& catalog, const Snapshot& snapshot) {
  const auto name_of_behavior = [&](BehaviorId id) { return catalog.name_of_behavior(id); };
  const auto write = [&](JsonWriter& json) {
    const auto& outcome = snapshot.outcome;
    json.write_members({{"schema", state_schema},
                        {"digest", to_hex(identity_of(catalog))},
                        {"time_us", snapshot.now},
                        {"events", snapshot.events},
                        {"reactive_delay_us", snapshot.reactive_delay}});
    if (!snapshot.timeouts) json.write("timeouts", false);
    json.write("outcome", outcome ? std::optional(name_of(*outcome)) : std::nullopt);
    json.write_list("running", snapshot.running, [&](const Snapshot::RunningTask& entry) {
      write_running(json, catalog, entry);
    });
    json.open("active", '{');
    for (const auto& [id, time] : snapshot.active) json.write(name_of_behavior(id), time);
    json.close('}');
    json.write_list("unavailable", snapshot.denied,
                    [&](BehaviorId id) { json.write(name_of_behavior(id)); });
    json.write_list("faulty", snapshot.faulty,
                    [&](BehaviorId id) { json.write(name_of_behavior(id)); });
    write_variables(json, catalog, "variables", snapshot.variables);
    json.open("queue", '{');
    for (const auto& [task, due] : snapshot.queue) json.write(catalog.name_of_task(task), due);
    json.close('}');
    json.write_list("waiting", snapshot.waiting,
                    [&](TaskId task) { json.write(catalog.name_of_task(task)); });
  };
  return json_line(write, JsonWriter::Layout::indented);
}

StateReading read_state(std::string_view text, const CompiledCatalog& catalog) {
  yaml::JsonReader reader;
  const Node* const root = reader.read(text);
  if (root == nullptr) return {std::nullopt, reader.fault()};
  try {
    return {StateReader(*root, catalog).read(), {}};
  } catch (const JsonFault& fault) {
    return {std::nullopt, fault.what()};
  }
}

}  // namespace cbc
