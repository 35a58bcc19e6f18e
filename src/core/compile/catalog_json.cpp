#include "core/compile/catalog_json.h"

#include <array>

namespace cbc::json {
namespace {

constexpr std::array<std::string_view, 2> text_or_truth = {"string", "boolean"};

}  // namespace

void PlainValue::put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
  json.write_list("type", text_or_truth);
  json.write("minLength", 1);
}

void ConditionValues::put(JsonWriter& json, const NamedCondition& condition) {
  json.begin('[');
  for (const std::string_view value : condition.values) {
    if (condition.is_boolean) {
      json.write(value == "true");
    } else {
      json.write(value);
    }
  }
  json.close(']');
}

void ConditionValues::put_schema(JsonWriter& json, Definitions& definitions) const {
  list(plain_value).at_least(1).put_schema(json, definitions);
}

}  // namespace cbc::json
