#include "report/reasons_json.h"

#include "report/reasons.h"
#include "text/json_writer.h"

namespace cbc {
namespace {

void write_reason(JsonWriter& json, const CompiledCatalog& catalog, const EventRecord& record,
                  const Reason& reason) {
  json.open('{');
  json.write_text("kind", name_of(reason.kind));
  if (reason.behavior != none) {
    json.write_text("behavior", catalog.name_of_behavior(reason.behavior));
  }
  if (reason.other_task != none) {
    json.open("tasks", '[');
    json.write_text(catalog.name_of_task(reason.task));
    json.write_text(catalog.name_of_task(reason.other_task));
    json.close(']');
  } else if (reason.task != none) {
    json.write_text("task", catalog.name_of_task(reason.task));
  }
  if (reason.kind == Reason::Kind::priority || reason.kind == Reason::Kind::is_protected) {
    json.write_integer("priority", reason.priority);
  }
  if (reason.line != 0) json.write_integer("line", reason.line);
  json.write_text("message", describe_reason(catalog, record, reason));
  json.close('}');
}

}  // namespace

std::string reasons_to_json(const CompiledCatalog& catalog, const EventRecord& record,
                            std::span<const Reason> reasons) {
  std::string text;
  JsonWriter json(text);
  json.open('[');
  for (const Reason& reason : reasons) write_reason(json, catalog, record, reason);
  json.close(']');
  return text;
}

}  // namespace cbc
