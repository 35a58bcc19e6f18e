#include "core/script/state_json.h"

#include <cstdint>
#include <functional>
#include <vector>

#include "cbc/event.h"
#include "core/script/names.h"
#include "core/support/json_description.h"
#include "core/yaml/document.h"
#include "core/yaml/json_value.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc {
namespace json::state {

using yaml::JsonFault;

/// The behavior of a running task.
struct Performer {
  using Running = Snapshot::RunningTask;

  void write(JsonWriter& json, const Running& running, const CompiledCatalog& catalog) const {
    const auto values = catalog.values[running.task];
    behavior.write(json, values[running.value_index].behavior, catalog);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    behavior.put_schema(json, definitions);
  }
  void read(const auto& json, Running& running, const CompiledCatalog& catalog) const {
    BehaviorId performer = none;
    behavior.read(json, performer, catalog);
    const auto values = catalog.values[running.task];
    for (std::uint32_t index = 0; index < values.size(); ++index) {
      if (values[index].behavior != performer) continue;
      running.value_index = index;
      return;
    }
    throw JsonFault("task " + quote(catalog.name_of_task(running.task)) + " runs with " +
                    quote(catalog.name_of_behavior(performer)) + ", which does not perform it");
  }
};

/// The values of all situation variables.
struct Variables {
  using Values = std::vector<std::uint32_t>;

  void write(JsonWriter& json, const Values& values, const CompiledCatalog& catalog) const {
    situation.write(json, entries_of(values, catalog), catalog);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    situation.put_schema(json, definitions);
  }
  void read(const auto& json, Values& values, const CompiledCatalog& catalog) const {
    values.assign(catalog.variables.size(), none);
    for (const yaml::JsonValue& value : json.members()) {
      const auto found = catalog.find_variable(value.name());
      if (!found) json.refuse_word("situation variable", value.name());
      const bool is_boolean = catalog.variables[*found].is_boolean != 0;
      const std::string word = !is_boolean ? value.text() : value.truth() ? "true" : "false";
      const auto place = catalog.find_value(*found, word);
      if (!place) fail(value.name(), " has no value " + quote(word));
      if (values[*found] != none) fail(value.name(), " has two values");
      values[*found] = *place;
    }
  }

  [[noreturn]] static void fail(std::string_view variable_name, const std::string& fault) {
    throw JsonFault("situation variable " + quote(variable_name) + fault);
  }
};

constexpr Integer time;

constexpr auto request = object(
    "request", "",
    member("priority", priority, "Higher is stronger; 0: the task started by itself.",
           &Request::priority),
    member("event", integer(1), "Number of the event that last set it.", &Request::event),
    member("parameters", any_text,
           "The parameters in a canonical form: two forms are equal exactly if the data are equal. "
           "Empty: none. Not meant for people.",
           &Request::parameters));

constexpr auto running_task = object(
    "running_task", "", member("task", task, "", &Snapshot::RunningTask::task),
    member("behavior", Performer(), "The behavior that performs it.", std::identity()),
    member("since_us", time, "The time since which this behavior has performed it.",
           &Snapshot::RunningTask::since),
    member("waits_for_timeout", boolean, "Whether its timeout, if it has one, is still pending.",
           &Snapshot::RunningTask::waits_for_timeout),
    member("request", nullable(request),
           "The request of the task. Null: it runs only because something requires it.",
           &Snapshot::RunningTask::request));

constexpr auto suspended_request = object(
    "suspended_request", "", member("task", task, "", &std::pair<TaskId, Request>::first),
    member("request", request, "The request that waits.", &std::pair<TaskId, Request>::second));

constexpr std::string_view schema_name = "cbc.state/1";

constexpr auto state = object(
    "",
    "The file that `cbc solve --format jsonl --state-out FILE` writes and --state-in reads (schema "
    "cbc.state/1): the complete state of a coordinator between two events. Times are in "
    "microseconds on its clock.",
    schema_member(schema_name),
    member("digest", digest,
           "XXH3-128 digest of the meaning of the catalog. The state is refused with another "
           "catalog.",
           [](const Snapshot&, const CompiledCatalog& of) { return to_hex(identity_of(of)); }),
    member("time_us", time, "The time on the clock.", &Snapshot::now),
    member("events", count, "Number of the last event.", &Snapshot::events),
    member("reactive_delay_us", integer(1),
           "The delay between the time when a reactive task could start and its start.",
           &Snapshot::reactive_delay),
    optional("timeouts", always_false,
             "Only in a run without timeouts; then no task waits for one.", &Snapshot::timeouts),
    member(
        "outcome", nullable(words(Outcome::unchanged)),
        "The outcome of the last scripted start, stop or finish, for an expectation; null: there "
        "was none.",
        &Snapshot::outcome),
    member("running", list(running_task), "The running tasks, in catalog order.",
           &Snapshot::running),
    member("active", map(behavior, time),
           "The active behaviors, in catalog order, and when each was activated.",
           &Snapshot::active),
    member("unavailable", behaviors, "Behaviors that a script made unavailable, in catalog order.",
           &Snapshot::denied),
    member("faulty", behaviors, "Behaviors whose activations fail, in catalog order.",
           &Snapshot::faulty),
    optional("variables", Variables(),
             "The values of all situation variables: true or false for those declared without "
             "values, texts for the others.",
             &Snapshot::variables),
    member("queue", map(task, time),
           "The scheduled reactive tasks, in catalog order, with the times when they are due.",
           &Snapshot::queue),
    optional("failed", if_any(map(behavior, time)),
             "Behaviors that have failed, and are not tried again at any event, in catalog order, "
             "and when each failed last.",
             &Snapshot::failed),
    optional("suspended", if_any(list(suspended_request)),
             "The suspended requests, in catalog order of their tasks.", &Snapshot::suspended),
    // States of cbc 0.1 have none.
    optional("waiting", tasks,
             "Reactive tasks whose start had no solution, and that wait for a change of their "
             "group, in catalog order.",
             &Snapshot::waiting));

/// Throws a JsonFault.
static Snapshot read(const yaml::JsonValue& root, const CompiledCatalog& catalog) {
  if (const std::string schema = root["schema"].text(); schema != schema_name) {
    throw JsonFault("its schema is " + quote(schema) + ", expected " + quote(schema_name));
  }
  const std::string found = root["digest"].text();
  if (const std::string expected = to_hex(identity_of(catalog)); found != expected) {
    throw JsonFault("it is the state of another catalog, with the digest " + quote(found) +
                    "; that of " + quote(catalog.file) + " is " + expected);
  }
  Snapshot snapshot;
  snapshot.variables.assign(catalog.variables.size(), none);
  state.read(root, snapshot, catalog);
  for (std::uint32_t variable = 0; variable < snapshot.variables.size(); ++variable) {
    if (snapshot.variables[variable] != none) continue;
    Variables::fail(catalog.name_of_variable(variable), " has no value");
  }
  if (const auto problem = find_inconsistency(catalog, snapshot)) throw JsonFault(*problem);
  return snapshot;
}

}  // namespace json::state

std::string write_state(const CompiledCatalog& catalog, const Snapshot& snapshot) {
  return json::document(json::state::state, snapshot, catalog, JsonWriter::Layout::indented);
}

std::string state_schema() { return json::schema("state", "A saved state", json::state::state); }

StateReading read_state(std::string_view text, const CompiledCatalog& catalog) {
  yaml::JsonReader reader;
  const yaml::Node* const root = reader.read(text);
  if (root == nullptr) return {std::nullopt, reader.fault()};
  try {
    return {json::state::read(yaml::JsonValue(*root), catalog), {}};
  } catch (const yaml::JsonFault& fault) {
    return {std::nullopt, fault.what()};
  }
}

}  // namespace cbc
