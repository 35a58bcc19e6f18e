#include "script/reader.h"

#include <utility>

#include "cbc/rules.h"
#include "diagnostic/reporter.h"
#include "script/shapes.h"
#include "script/step_reader.h"
#include "text/quote.h"
#include "yaml/fields.h"
#include "yaml/values.h"

namespace cbc {
namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

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
  fields.report_unknown(Severity::error);
}

void resume(StepReader& reader, const CompiledCatalog& catalog, const Snapshot& snapshot) {
  State state(catalog);
  for (const BehaviorId behavior : snapshot.unavailable) state.set_available(behavior, false);
  reader.resume(snapshot.now, state);
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
  if (state != nullptr) resume(reader, catalog, *state);
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
