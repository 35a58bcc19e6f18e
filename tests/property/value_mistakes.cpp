#include <algorithm>

#include "lint_mutations.h"

namespace cbc::mutation {
namespace {

using Result = std::optional<Mutation>;
using Words = std::vector<std::string>;

bool is_one_of(const Field& field, const std::set<std::string_view>& keys) {
  return keys.contains(field.key);
}

const std::set<std::string_view> percentages{"suitability", "efficacy", "minimum_performance"};
const std::set<std::string_view> flags{"start_on_request", "reactive_start", "automatic_activation",
                                       "default"};
const std::set<std::string_view> goals{"execution_goal"};
const std::set<std::string_view> times{"timeout"};
const std::set<std::string_view> names{"task", "behavior", "parameter"};

/// Puts one of the values in the place of one that has a key of `keys`.
Result put(const CatalogOutline& catalog, Random& random, const std::set<std::string_view>& keys,
           const Words& values, std::string_view rule, const std::string& says = {}) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [&](const PlacedField& each) {
    return is_one_of(*each.field, keys) && each.field->value.kind == Item::Kind::scalar;
  });
  if (placed == nullptr) return std::nullopt;
  Lines lines = catalog.lines();
  set_value(lines, *placed->field, random.pick(values));
  const Item& value = placed->field->value;
  // The effect of the value is gone.
  return Mutation{lines.text(), {at(lines, rule, value.line, value.column, says)}};
}

Result percent_out_of_range(const CatalogOutline& catalog, Random& random) {
  return put(catalog, random, percentages, {"120", "-5", "100.5", "101", "1000000", "-0.1"},
             "invalid-value", "0 to 100");
}

Result percent_too_precise(const CatalogOutline& catalog, Random& random) {
  return put(catalog, random, percentages, {"80.12345", "99.999999"}, "invalid-value", "decimals");
}

Result percent_no_number(const CatalogOutline& catalog, Random& random) {
  return put(catalog, random, percentages,
             {"high", "80%", "\"80\"", "'80'", "[80]", "[]", "80 90", "TRUE", "8O"}, "wrong-type");
}

Result flag_no_boolean(const CatalogOutline& catalog, Random& random) {
  return put(catalog, random, flags, {"maybe", "\"TRUE\"", "[TRUE]", "1", "tRUE", "TRUE FALSE"},
             "wrong-type", "true or false");
}

Result goal_misspelt(const CatalogOutline& catalog, Random& random) {
  return put(catalog, random, goals, {"keep_runing", "keeprunning", "Keep_Running"},
             "invalid-value", "did you mean 'keep_running'?");
}

Result goal_unknown(const CatalogOutline& catalog, Random& random) {
  return put(catalog, random, goals, {"forever", "TRUE", "7"}, "invalid-value");
}

Result time_out_of_range(const CatalogOutline& catalog, Random& random) {
  return put(catalog, random, times, {"-5", "0", "0.0", "-0.5", "1.23456789", "99999999999999"},
             "invalid-value");
}

Result time_no_number(const CatalogOutline& catalog, Random& random) {
  return put(catalog, random, times, {"soon", "15s", "\"15\"", "[15]", "1 5", "1:30"},
             "wrong-type");
}

/// A list or a mapping of one where a plain text belongs.
Result list_for_text(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return each.field->value.kind == Item::Kind::scalar &&
           (is_one_of(*each.field, names) || each.field->key == "package");
  });
  if (placed == nullptr) return std::nullopt;
  Lines lines = catalog.lines();
  const Field& field = *placed->field;
  if (random.percent(60)) {
    set_value(lines, field, "[" + field.value.text + "]");
  } else if (random.percent(50)) {
    set_value(lines, field, "{name: " + field.value.text + "}");
  } else {
    // In block style it begins a line below.
    lines.set(field.line, lines[field.line].substr(0, field.value.column - 1));
    lines.insert_after(field.line, spaces(field.column + 2) + "- " + field.value.text);
    return Mutation{lines.text(), {at(lines, "wrong-type", field.line + 1, field.column + 2)}};
  }
  return Mutation{lines.text(), {at(lines, "wrong-type", field.line, field.value.column)}};
}

Result text_for_list(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return each.field->value.kind == Item::Kind::list && each.field->key != "allowed_values";
  });
  if (placed == nullptr) return std::nullopt;
  Lines lines = catalog.lines();
  const Field& field = *placed->field;
  static const Words values{"NOTHING", "80", "\"\"", "{}", "{task: A}"};
  lines.erase(field.line, field.last_line);
  const std::string before = catalog.lines()[field.line].substr(0, field.column);
  lines.insert_after(field.line - 1, before + field.key + ": " + random.pick(values));
  // Defaults may be a mapping.
  if (placed->shape->name == "default_values" || field.key == "default_values") return std::nullopt;
  return Mutation{lines.text(),
                  {at(lines, "wrong-type", field.line, field.column + field.key.size() + 2,
                      in_quotes(field.key))},
                  {"duplicate-exclusion"}};  // says of which list
}

/// A name alone where `key: name` belongs.
Result bare_entry(const CatalogOutline& catalog, Random& random) {
  const Mapping* mapping = pick_if(catalog.mappings(), random, [](const Mapping& each) {
    if (each.shape->name == "catalog" || each.item->fields.size() != 1) return false;
    const Field& only = each.item->fields.front();
    return is_one_of(only, names) || only.key == "mutually_exclusive";
  });
  if (mapping == nullptr) return std::nullopt;
  const Field& only = mapping->item->fields.front();
  if (only.value.kind == Item::Kind::list && !only.value.flow) return std::nullopt;
  Lines lines = catalog.lines();
  lines.replace(only.line, only.column, only.value.column - only.column, "");
  return Mutation{lines.text(), {at(lines, "wrong-type", only.line, only.column)}};
}

Result no_performed_task(const CatalogOutline& catalog, Random& random) {
  const Mapping* mapping = pick_if(catalog.mappings(), random, [](const Mapping& each) {
    return each.shape->name == "behavior" && each.item->find("tasks") != nullptr;
  });
  if (mapping == nullptr) return std::nullopt;
  const Field& field = *mapping->item->find("tasks");
  Lines lines = catalog.lines();
  lines.erase(field.line, field.last_line);
  lines.insert_after(field.line - 1, spaces(field.column) + "tasks: []");
  return Mutation{lines.text(), {at(lines, "invalid-value", field.line, field.column)}};
}

}  // namespace

std::vector<MistakeKind> value_mistakes() {
  return {{"percentage out of range", percent_out_of_range},
          {"percentage too precise", percent_too_precise},
          {"percentage no number", percent_no_number},
          {"flag no boolean", flag_no_boolean},
          {"execution_goal misspelt", goal_misspelt},
          {"execution_goal unknown", goal_unknown},
          {"timeout out of range", time_out_of_range},
          {"timeout no number", time_no_number},
          {"list for a text", list_for_text},
          {"text for a list", text_for_list},
          {"name alone for an entry", bare_entry},
          {"no performed task", no_performed_task}};
}

}  // namespace cbc::mutation
