#include "script/event_lines.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cbc/event.h"
#include "compiled/compiled_file.h"
#include "diagnostic/diagnostic.h"
#include "diagnostic/rules.h"
#include "script/reader.h"
#include "support/json.h"
#include "yaml/document.h"
#include "yaml/values.h"

namespace cbc {

EventLines::Reading EventLines::read(std::string_view line, std::uint32_t number) {
  Reading reading;
  if (line.ends_with('\r')) line.remove_suffix(1);  // Windows ends lines so
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos || line[begin] == '#') return reading;

  Diagnostics diagnostics;
  std::unique_ptr<const yaml::Document> document;
  const yaml::Node* node = json_.read(line, number);
  if (node == nullptr) {
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

constexpr std::string_view events_schema = "cbc.events/1";

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

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view state_schema = "cbc.state/1";

Json request_to_json(const std::optional<Request>& request) {
  if (!request) return nullptr;
  return {{"priority", request->priority},
          {"event", request->event},
          {"parameters", request->parameters}};
}

/// What makes a file no state; becomes the error.
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class StateReader {
 public:
  StateReader(const Json& root, const CompiledCatalog& catalog) : root_(root), catalog_(catalog) {}

  [[nodiscard]] Snapshot read() {
    if (!root_.is_object()) throw Refusal("it is no JSON object");
    if (text(root_, "schema") != state_schema) {
      throw Refusal(fmt::format("its schema is {}, expected {}", quote(text(root_, "schema")),
                                quote(state_schema)));
    }
    if (const std::string digest = to_hex(identity_of(catalog_)); text(root_, "digest") != digest) {
      throw Refusal(
          fmt::format("it is the state of another catalog, with the digest {}; that of {} is {}",
                      quote(text(root_, "digest")), quote(catalog_.file), digest));
    }
    out_.now = integer<Microseconds>(root_, "time_us");
    out_.events = integer<std::uint64_t>(root_, "events");
    out_.reactive_delay = integer<Microseconds>(root_, "reactive_delay_us");
    out_.outcome = outcome();
    for (const Json& entry : list("running")) read_task(entry);
    for (const auto& [name, time] : mapping("active").items()) {
      out_.active.emplace_back(behavior(name), to_integer<Microseconds>(time, name));
    }
    for (const Json& name : list("unavailable")) {
      out_.unavailable.push_back(behavior(to_text(name, "unavailable")));
    }
    for (const Json& name : list("faulty")) {
      out_.faulty.push_back(behavior(to_text(name, "faulty")));
    }
    for (const auto& [name, due] : mapping("queue").items()) {
      out_.queue.emplace_back(task(name), to_integer<Microseconds>(due, name));
    }
    if (const auto problem = find_inconsistency(catalog_, out_)) throw Refusal(*problem);
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::optional<Outcome> outcome() const {
    const Json& value = member(root_, "outcome");
    if (value.is_null()) return std::nullopt;
    for (const Outcome outcome : {Outcome::accepted, Outcome::rejected, Outcome::unchanged}) {
      if (value == name_of(outcome)) return outcome;
    }
    throw Refusal("'outcome' is none that there is");
  }

  void read_task(const Json& entry) {
    if (!entry.is_object()) throw Refusal("an entry of 'running' is no object");
    Snapshot::RunningTask& running = out_.running.emplace_back();
    running.task = task(text(entry, "task"));
    running.value_index = value_index(running.task, behavior(text(entry, "behavior")));
    running.since = integer<Microseconds>(entry, "since_us");
    const Json& waits = member(entry, "waits_for_timeout");
    if (!waits.is_boolean()) throw Refusal("'waits_for_timeout' is neither true nor false");
    running.waits_for_timeout = waits.get<bool>();
    const Json& request = member(entry, "request");
    if (request.is_null()) return;
    if (!request.is_object()) throw Refusal("'request' is neither an object nor null");
    running.request =
        Request{integer<std::int32_t>(request, "priority"),
                integer<std::uint64_t>(request, "event"), text(request, "parameters")};
  }

  [[nodiscard]] TaskId task(const std::string& name) const {
    if (const auto found = catalog_.find_task(name)) return catalog_.task_ids[*found];
    throw Refusal(fmt::format("there is no task {}", quote(name)));
  }
  [[nodiscard]] BehaviorId behavior(const std::string& name) const {
    if (const auto found = catalog_.find_behavior(name)) return catalog_.behavior_ids[*found];
    throw Refusal(fmt::format("there is no behavior {}", quote(name)));
  }
  [[nodiscard]] std::uint32_t value_index(TaskId task, BehaviorId behavior) const {
    const auto values = catalog_.values[task];
    for (std::uint32_t index = 0; index < values.size(); ++index) {
      if (values[index].behavior == behavior) return index;
    }
    throw Refusal(fmt::format("task {} runs with {}, which does not perform it",
                              quote(catalog_.name_of_task(task)),
                              quote(catalog_.name_of_behavior(behavior))));
  }

  [[nodiscard]] static const Json& member(const Json& object, const char* name) {
    const auto found = object.find(name);
    if (found == object.end()) throw Refusal(fmt::format("{} is missing", quote(name)));
    return *found;
  }
  [[nodiscard]] static std::string to_text(const Json& value, std::string_view name) {
    if (!value.is_string()) throw Refusal(fmt::format("{} is no text", quote(name)));
    return value.get<std::string>();
  }
  [[nodiscard]] static std::string text(const Json& object, const char* name) {
    return to_text(member(object, name), name);
  }
  template <typename Integer>
  [[nodiscard]] static Integer to_integer(const Json& value, std::string_view name) {
    // All of them are at least 0, and none needs the highest bit.
    if (value.is_number_unsigned() &&
        value.get<std::uint64_t>() <=
            static_cast<std::uint64_t>(std::numeric_limits<Integer>::max())) {
      return static_cast<Integer>(value.get<std::uint64_t>());
    }
    throw Refusal(fmt::format("{} is not a whole number in its range", quote(name)));
  }
  template <typename Integer>
  [[nodiscard]] static Integer integer(const Json& object, const char* name) {
    return to_integer<Integer>(member(object, name), name);
  }
  [[nodiscard]] const Json& list(const char* name) const {
    const Json& value = member(root_, name);
    if (!value.is_array()) throw Refusal(fmt::format("{} is no list", quote(name)));
    return value;
  }
  [[nodiscard]] const Json& mapping(const char* name) const {
    const Json& value = member(root_, name);
    if (!value.is_object()) throw Refusal(fmt::format("{} is no object", quote(name)));
    return value;
  }

  const Json& root_;
  const CompiledCatalog& catalog_;
  Snapshot out_;
};

}  // namespace

std::string write_state(const CompiledCatalog& catalog, const Snapshot& snapshot) {
  const auto add = [](Json& object, std::string_view name, const auto& value) {
    object[std::string(name)] = value;
  };
  Json running = Json::array();
  for (const Snapshot::RunningTask& entry : snapshot.running) {
    const BehaviorId behavior = catalog.values[entry.task][entry.value_index].behavior;
    running.push_back({{"task", catalog.name_of_task(entry.task)},
                       {"behavior", catalog.name_of_behavior(behavior)},
                       {"since_us", entry.since},
                       {"waits_for_timeout", entry.waits_for_timeout},
                       {"request", request_to_json(entry.request)}});
  }
  Json active = Json::object();
  for (const auto& [behavior, time] : snapshot.active) {
    add(active, catalog.name_of_behavior(behavior), time);
  }
  Json unavailable = Json::array();
  for (const BehaviorId behavior : snapshot.unavailable) {
    unavailable.push_back(catalog.name_of_behavior(behavior));
  }
  Json faulty = Json::array();
  for (const BehaviorId behavior : snapshot.faulty) {
    faulty.push_back(catalog.name_of_behavior(behavior));
  }
  Json queue = Json::object();
  for (const auto& [task, due] : snapshot.queue) add(queue, catalog.name_of_task(task), due);
  const Json root = {{"schema", state_schema},
                     {"digest", to_hex(identity_of(catalog))},
                     {"time_us", snapshot.now},
                     {"events", snapshot.events},
                     {"reactive_delay_us", snapshot.reactive_delay},
                     {"outcome", snapshot.outcome ? Json(name_of(*snapshot.outcome)) : Json()},
                     {"running", std::move(running)},
                     {"active", std::move(active)},
                     {"unavailable", std::move(unavailable)},
                     {"faulty", std::move(faulty)},
                     {"queue", std::move(queue)}};
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

StateReading read_state(std::string_view text, const CompiledCatalog& catalog) {
  StateReading reading;
  constexpr std::size_t deepest = 6;  // no state has more
  if (nesting_of(text) > deepest) {
    reading.error = "it is nested too deep";
    return reading;
  }
  const Json root = Json::parse(text, nullptr, false);
  if (root.is_discarded()) {
    reading.error = "it is no JSON, or damaged";
    return reading;
  }
  try {
    reading.snapshot = StateReader(root, catalog).read();
  } catch (const Refusal& refusal) {
    reading.error = refusal.what();
  }
  return reading;
}

}  // namespace cbc
