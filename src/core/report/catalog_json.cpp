#include "core/report/catalog_json.h"

#include "core/catalog/situation.h"

namespace cbc {

void write_plain_value(JsonWriter& json, const CompiledCatalog& catalog, VariableValue value) {
  if (catalog.variables[value.variable].is_boolean != 0) {
    json.write(value.value == 0);
  } else {
    json.write(catalog.name_of_value(value));
  }
}

void write_variable(JsonWriter& json, const CompiledCatalog& catalog, std::uint32_t index) {
  const CompiledVariable& variable = catalog.variables[index];
  json.open('{');
  json.write("variable", catalog.name_of_variable(index));
  json.open("values", '[');
  for (std::uint32_t value = 0; value < variable.value_count; ++value) {
    write_plain_value(json, catalog, {index, value});
  }
  json.close(']');
  json.close('}');
}

void write_conditions(JsonWriter& json, std::span<const NamedCondition> conditions) {
  json.open("situation", '{');
  for (const NamedCondition& condition : conditions) {
    json.write_list(condition.variable, condition.values, [&](std::string_view value) {
      if (condition.is_boolean) {
        json.write(value == "true");
      } else {
        json.write(value);
      }
    });
  }
  json.close('}');
}

void write_constraints(JsonWriter& json, const ConstraintCount& constraints) {
  json.write_object("constraints", {{"exclusive_pairs", constraints.exclusive_pairs},
                                    {"requirements", constraints.requirements},
                                    {"task_minimums", constraints.task_minimums},
                                    {"total", constraints.total()}});
}

}  // namespace cbc
