#include "event_case.h"

#include <cstddef>
#include <exception>

#include <nlohmann/json.hpp>

#include "conflict_check.h"
#include "oracle.h"
#include "subject.h"
#include "yaml_text.h"

namespace cbc::oracle {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

// The type that a scalar of a parameter has in JSON is free; its text is not.
json scalars_as_text(const ordered_json& value) {
  if (value.is_object() || value.is_array()) {
    json result = value.is_object() ? json::object() : json::array();
    for (const auto& [key, item] : value.items()) {
      if (value.is_object()) {
        result[key] = scalars_as_text(item);
      } else {
        result.push_back(scalars_as_text(item));
      }
    }
    return result;
  }
  return value.is_null() || value.is_string() ? json(value) : json(value.dump());
}

// What is compared of an event. The order of keys matters only where it is catalog order.
json comparable(ordered_json event) {
  event.erase("conflict");
  if (event.contains("search") && event["search"].is_object()) {
    event["search"].erase("solutions");
    event["search"].erase("nodes");
    event["search"].erase("elapsed_us");
  }
  // Whether there are reasons, but not which ones: another test judges them.
  for (ordered_json& stopped : event["stopped_tasks"]) {
    if (stopped.contains("conflict")) {
      stopped["conflict"] = ordered_json::array();
    }
    stopped.erase("message");
  }
  json result = event;
  if (event.contains("parameters")) {
    result["parameters"] = scalars_as_text(event["parameters"]);
  }
  for (const char* key : {"running", "requests", "suspended", "queue"}) {
    json pairs = json::array();
    if (event.contains(key)) {
      for (const auto& [name, value] : event[key].items()) {
        pairs.push_back({name, value});
      }
    }
    result[key] = pairs;
  }
  return result;
}

// The index of the first event that differs; the number of events if none does.
std::size_t first_difference(const ordered_json& expected, const ordered_json& actual) {
  std::size_t i = 0;
  while (i < expected.size() && i < actual.size() &&
         comparable(expected[i]) == comparable(actual[i])) {
    ++i;
  }
  return i;
}

std::string event_text(const ordered_json& events, std::size_t index) {
  return index < events.size() ? events[index].dump(1) : "no such event";
}

}  // namespace

std::optional<std::string> find_fault(const Case& sample, Random& forms, Statistics* statistics) {
  const std::string catalog = catalog_yaml(sample.catalog, forms);
  const std::string script = script_yaml(sample.catalog, sample.script, forms);
  const ordered_json expected = run_oracle(sample.catalog, sample.script, statistics);

  const std::string inputs = "--- catalog\n" + catalog + "--- script\n" + script;
  try {
    const ordered_json actual = run_subject(catalog, script);
    const std::size_t index = first_difference(expected, actual);
    if (index < expected.size() || index < actual.size()) {
      return inputs + "--- first difference: event " + std::to_string(index + 1) +
             "\n--- oracle\n" + event_text(expected, index) + "\n--- subject\n" +
             event_text(actual, index) + "\n";
    }
    if (sample.catalog.has_further_keys()) return std::nullopt;
    const std::optional<ConflictFault> fault =
        check_conflicts(CatalogFacts(sample.catalog), sample.script, actual, statistics);
    if (!fault) return std::nullopt;
    return inputs + "--- wrong conflict: event " + std::to_string(fault->event + 1) + "\n" +
           fault->what + "\n--- subject\n" + event_text(actual, fault->event) + "\n";
  } catch (const std::exception& error) {
    return inputs + "--- refused\n" + error.what() + "\n";
  }
}

}  // namespace cbc::oracle
