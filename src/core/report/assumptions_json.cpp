#include "core/report/assumptions_json.h"

#include <optional>
#include <string>

#include "core/report/catalog_json.h"

namespace cbc {
namespace {

void write_situation(JsonWriter& json, const CompiledCatalog& catalog, const SituationPart& part) {
  for (const VariableValue value : part.variables) {
    json.key(catalog.name_of_variable(value.variable));
    write_plain_value(json, catalog, value);
  }
  for (const SituationPart::Own& own : part.behaviors) {
    json.write(catalog.name_of_behavior(own.behavior), own.available);
  }
}

}  // namespace

void write_assumptions(JsonWriter& json, const CompiledCatalog& catalog,
                       const StatedAssumptions& stated) {
  const Assumptions& assumptions = stated.assumptions;
  json.open('{');
  json.write("file", stated.file.empty() ? std::nullopt : std::optional(stated.file));
  json.open("start", '{');
  for (const Assumptions::Start& start : assumptions.start) {
    json.write_list(catalog.name_of_task(start.task), start.priorities);
  }
  json.close('}');
  json.write_list("stop", assumptions.stop,
                  [&](TaskId task) { json.write(catalog.name_of_task(task)); });
  json.write_members({{"successes", assumptions.successes},
                      {"failures", assumptions.failures},
                      {"faults", assumptions.faults}});
  json.open("situation", '[');
  for (const std::uint32_t variable : assumptions.variables) {
    json.write(catalog.name_of_variable(variable));
  }
  for (const BehaviorId behavior : assumptions.behaviors) {
    json.write(catalog.name_of_behavior(behavior));
  }
  json.close(']');
  json.write_list("never", assumptions.never, [&](const SituationPart& part) {
    json.open('{');
    write_situation(json, catalog, part);
    json.close('}');
  });
  json.open("initially", '{');
  write_situation(json, catalog, assumptions.initially);
  json.close('}');
  json.close('}');
}

}  // namespace cbc
