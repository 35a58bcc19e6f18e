#include "coordinator/saved_state.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cbc/event.h"
#include "compiled/identity.h"
#include "text/json_nesting.h"
#include "text/quote.h"

namespace cbc {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view schema = "cbc.state/1";

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
    if (text(root_, "schema") != schema) {
      throw Refusal(fmt::format("its schema is {}, expected {}", quote(text(root_, "schema")),
                                quote(schema)));
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
    running.place = place(running.task, behavior(text(entry, "behavior")));
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
  [[nodiscard]] std::uint32_t place(TaskId task, BehaviorId behavior) const {
    const auto values = catalog_.values[task];
    for (std::uint32_t place = 0; place < values.size(); ++place) {
      if (values[place].behavior == behavior) return place;
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
    const BehaviorId behavior = catalog.values[entry.task][entry.place].behavior;
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
  const Json root = {{"schema", schema},
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
