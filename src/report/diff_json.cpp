#include "report/diff_json.h"

#include "text/json_writer.h"

namespace cbc {
namespace {

void write_value(JsonWriter& json, std::string_view name, const AttributeValue& value) {
  if (const bool* const truth = std::get_if<bool>(&value)) {
    json.write_truth(name, *truth);
  } else if (const Millionths* const degree = std::get_if<Millionths>(&value)) {
    json.write_number(name, *degree / 10'000.0);
  } else if (const Microseconds* const time = std::get_if<Microseconds>(&value)) {
    json.write_number(name, static_cast<double>(*time) / 1'000'000.0);
  } else if (const std::string* const text = std::get_if<std::string>(&value)) {
    json.write_text(name, *text);
  } else {
    json.write_null(name);
  }
}

void write_change(JsonWriter& json, const CatalogChange& change) {
  json.open('{');
  json.write_text("kind", name_of(change.kind));
  json.write_text("subject", name_of(change.subject));
  if (!change.behavior.empty()) json.write_text("behavior", change.behavior);
  if (!change.task.empty()) json.write_text("task", change.task);
  if (!change.other_task.empty()) json.write_text("other_task", change.other_task);
  json.open("attributes", '[');
  for (const AttributeChange& attribute : change.attributes) {
    json.open('{');
    json.write_text("name", attribute.name);
    write_value(json, "before", attribute.before);
    write_value(json, "after", attribute.after);
    json.close('}');
  }
  json.close(']');
  json.close('}');
}

}  // namespace

std::string diff_json(const CatalogDiff& diff, std::string_view before, std::string_view after) {
  std::string text;
  JsonWriter json(text);
  json.open('{');
  json.write_text("schema", "cbc.diff/1");
  json.write_text("old", before);
  json.write_text("new", after);
  json.open("changes", '[');
  for (const CatalogChange& change : diff.changes) write_change(json, change);
  json.close(']');
  json.write_integer("further_exclusions", diff.further_exclusions);
  json.close('}');
  return text += '\n';
}

}  // namespace cbc
