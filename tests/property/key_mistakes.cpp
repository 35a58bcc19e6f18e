#include <algorithm>
#include <utility>

#include "lint_mutations.h"

namespace cbc::mutation {
namespace {

using Result = std::optional<Mutation>;

bool contains(const std::vector<std::string_view>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_known_anywhere(std::string_view key) {
  const auto& shapes = all_shapes();
  return std::any_of(shapes.begin(), shapes.end(),
                     [key](const Shape& shape) { return contains(shape.keys, key); });
}

bool is_required(const PlacedField& placed) {
  return contains(placed.shape->required, placed.field->key);
}

/// What is unknown in an entry is reported in other words if the entry has no name.
bool has_known_keys_only(const PlacedField& placed) {
  const auto& fields = placed.mapping->fields;
  return std::all_of(fields.begin(), fields.end(),
                     [&](const Field& field) { return contains(placed.shape->keys, field.key); });
}

/// Without a name an entry is reported where it begins; without a task, at the name of the
/// behavior.
Result drop_key(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return is_required(each) && each.shape->name != "catalog" && each.mapping->fields.size() > 1 &&
           has_known_keys_only(each);
  });
  if (placed == nullptr) return std::nullopt;
  Lines lines = catalog.lines();
  std::size_t line = remove_field(lines, *placed->mapping, *placed->field);
  std::string key = placed->field->key == "tasks" ? "task" : placed->field->key;
  if (placed->shape->name == "behavior" && key == "task") {
    const Field& name = *placed->mapping->find("behavior");
    line = name.line;
    if (name.line > placed->field->line) {
      line -= placed->field->last_line - placed->field->line + 1;
    }
  }
  return Mutation{lines.text(), {{"missing-key", {line}, std::nullopt, "key " + in_quotes(key)}}};
}

Result empty_required_key(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return is_required(each) && each.field->value.kind == Item::Kind::scalar &&
           has_known_keys_only(each);
  });
  if (placed == nullptr) return std::nullopt;
  static const std::vector<std::string> nothings{"", "~", "null"};
  Lines lines = catalog.lines();
  set_value(lines, *placed->field, random.pick(nothings));
  return Mutation{lines.text(),
                  {at(lines, "missing-key", placed->field->line, placed->field->column,
                      in_quotes(placed->field->key) + " has no value")}};
}

std::string key_misspelling(const PlacedField& placed, Random& random) {
  const std::string& key = placed.field->key;
  std::string wrong = misspell(key, random);
  const bool is_clear =
      is_clear_misspelling(wrong, key, placed.shape->keys) && !is_known_anywhere(wrong);
  return is_clear ? wrong : std::string();
}

Result misspell_required_key(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, is_required);
  if (placed == nullptr) return std::nullopt;
  const Field& field = *placed->field;
  const std::string wrong = key_misspelling(*placed, random);
  if (wrong.empty()) return std::nullopt;
  Lines lines = catalog.lines();
  lines.replace(field.line, field.column, field.key.size(), wrong);
  return Mutation{
      lines.text(),
      {at(lines, "missing-key", field.line, field.column,
          in_quotes(wrong) + " is unknown; did you mean " + in_quotes(field.key) + "?")}};
}

/// What follows from the absence of a key that is not required.
const std::set<std::string_view> changes_without_key{"conflicting-requirements",
                                                     "dead-behavior",
                                                     "dead-task",
                                                     "implicit-task",
                                                     "no-timeout-effect",
                                                     "reactive-timeout",
                                                     "redundant-requirement",
                                                     "required-goal",
                                                     "requires-on-request",
                                                     "task-without-behavior",
                                                     "unreachable-performance",
                                                     "suspicious-suitability"};

Result misspell_optional_key(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    const std::string& key = each.field->key;
    // Of an older name the present one is suggested.
    return !is_required(each) && contains(each.shape->keys, key) && key != "efficacy" &&
           key != "category" && key != "default" && key != "automatic_activation";
  });
  if (placed == nullptr) return std::nullopt;
  const Field& field = *placed->field;
  const std::string wrong = key_misspelling(*placed, random);
  if (wrong.empty()) return std::nullopt;
  Lines lines = catalog.lines();
  lines.replace(field.line, field.column, field.key.size(), wrong);
  return Mutation{lines.text(),
                  {at(lines, "unknown-key", field.line, field.column,
                      "did you mean " + in_quotes(field.key) + "?")},
                  changes_without_key};
}

Result strange_key(const CatalogOutline& catalog, Random& random) {
  const Mapping* mapping = pick_if(catalog.mappings(), random,
                                   [](const Mapping& each) { return !each.item->fields.empty(); });
  if (mapping == nullptr) return std::nullopt;
  static const std::vector<std::string> keys{"quaternion: 7", "Zzz: [A, B]", "weight_in_grams:"};
  Lines lines = catalog.lines();
  const std::string& content = random.pick(keys);
  const std::size_t line = add_field(lines, *mapping->item, content);
  return Mutation{lines.text(),
                  {at(lines, "unknown-key", line, mapping->item->column,
                      in_quotes(content.substr(0, content.find(':'))))}};
}

/// At the very end of the file, what is left is a key without a value; elsewhere it is no YAML.
Result no_space_after_colon(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return !is_required(each) && each.field->value.kind == Item::Kind::scalar &&
           each.mapping->fields.size() > 1;
  });
  if (placed == nullptr) return std::nullopt;
  const Field& field = *placed->field;
  Lines lines = catalog.lines();
  const std::size_t end = field.column + field.key.size() + 1;
  lines.replace(field.line, end, field.value.column - end, "");
  const bool has_comment = lines[field.line].find(" #") != std::string::npos;
  if (field.line == catalog.root().last_line && !has_comment) {
    return Mutation{lines.text(),
                    {at(lines, "unknown-key", field.line, field.column, "space missing")},
                    changes_without_key};
  }
  return Mutation{lines.text(),
                  {at(lines, "yaml-syntax", field.line, field.column, "the space after it")}};
}

Result key_twice(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return each.field->value.kind == Item::Kind::scalar || each.field->value.flow;
  });
  if (placed == nullptr) return std::nullopt;
  const Field& field = *placed->field;
  Lines lines = catalog.lines();
  const std::string content = lines[field.line].substr(field.column);
  lines.insert_after(placed->mapping->last_line, spaces(field.column) + content);
  return Mutation{lines.text(),
                  {at(lines, "duplicate-key", placed->mapping->last_line + 1, field.column,
                      in_quotes(field.key) + " is given twice")}};
}

/// A section in two parts, each under its key.
Result section_twice(const CatalogOutline& catalog, Random& random) {
  const Field* section = pick_if(catalog.root().fields, random, [](const Field& field) {
    return field.key != "default_values" && field.value.items.size() > 1;
  });
  if (section == nullptr) return std::nullopt;
  const auto& entries = section->value.items;
  const std::size_t cut = 1 + random.below(entries.size() - 1);
  Lines lines = catalog.lines();
  const std::size_t line = entries[cut - 1].last_line + 1;
  lines.insert_after(line - 1, section->key + ":");
  return Mutation{lines.text(), {at(lines, "duplicate-key", line, 0, in_quotes(section->key))}};
}

struct OlderName {
  std::string_view present;
  std::string_view older;
};

constexpr OlderName older_names[] = {{"suitability", "efficacy"},
                                     {"execution_goal", "category"},
                                     {"start_on_request", "automatic_activation"},
                                     {"reactive_start", "default"}};

/// The older name of a key, and the value that means the same.
std::optional<std::pair<std::string, std::string>> in_older_words(const Field& field) {
  const std::string& value = field.value.text;
  for (const auto& [present, older] : older_names) {
    if (field.key != present) continue;
    if (present == "execution_goal") {
      return std::pair(std::string(older), value == "keep_running" ? "recurrent" : "goal_based");
    }
    if (present != "start_on_request") return std::pair(std::string(older), value);
    const bool is_true = value == "TRUE" || value == "true" || value == "yes";
    return std::pair(std::string(older), is_true ? "FALSE" : "TRUE");
  }
  return std::nullopt;
}

Result older_name(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return in_older_words(*each.field).has_value();
  });
  if (placed == nullptr) return std::nullopt;
  const Field& field = *placed->field;
  const auto [key, value] = *in_older_words(field);
  Lines lines = catalog.lines();
  set_value(lines, field, value);
  lines.replace(field.line, field.column, field.key.size(), key);
  return Mutation{lines.text(),
                  {at(lines, "deprecated-key", field.line, field.column,
                      in_quotes(key) + " is an older name: write '" + field.key)}};
}

Result both_names(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return in_older_words(*each.field).has_value();
  });
  if (placed == nullptr) return std::nullopt;
  const auto [key, value] = *in_older_words(*placed->field);
  Lines lines = catalog.lines();
  const std::size_t line = add_field(lines, *placed->mapping, key + ": " + value);
  return Mutation{lines.text(),
                  {at(lines, "duplicate-key", line, placed->mapping->column, in_quotes(key))}};
}

/// The last key of the last entry of a list, put where the list itself stands.
Result one_level_up(const CatalogOutline& catalog, Random& random) {
  struct Place {
    const Item* outer;
    const Field* field;
  };
  std::vector<Place> places;
  for (const Mapping& mapping : catalog.mappings()) {
    for (const Field& list : mapping.item->fields) {
      if (list.key != "parameters" && list.key != "requires") continue;
      if (list.value.items.empty()) continue;
      const Item& entry = list.value.items.back();
      if (entry.fields.size() < 2 || entry.fields.back().value.kind == Item::Kind::null) continue;
      const std::string_view key = entry.fields.back().key;
      if (key != "allowed_values" && key != "minimum_performance") continue;
      if (key == "minimum_performance" && mapping.shape->name != "behavior") continue;
      places.push_back({mapping.item, &entry.fields.back()});
    }
  }
  if (places.empty()) return std::nullopt;
  const Place place = random.pick(places);
  Lines lines = catalog.lines();
  const std::size_t line = place.field->line;
  lines.replace(line, 0, place.field->column, spaces(place.outer->column));
  return Mutation{lines.text(),
                  {at(lines, "unknown-key", line, place.outer->column, "one level down")},
                  changes_without_key};
}

Result one_level_down(const CatalogOutline& catalog, Random& random) {
  const Mapping* mapping = pick_if(catalog.mappings(), random, [](const Mapping& each) {
    return each.shape->name == "requirement" || each.shape->name == "parameter";
  });
  if (mapping == nullptr) return std::nullopt;
  const bool is_requirement = mapping->shape->name == "requirement";
  Lines lines = catalog.lines();
  const std::size_t line =
      add_field(lines, *mapping->item, is_requirement ? "suitability: 80" : "timeout: 20");
  return Mutation{lines.text(),
                  {at(lines, "unknown-key", line, mapping->item->column, "one level up")}};
}

Result key_of_a_task_in_a_behavior(const CatalogOutline& catalog, Random& random) {
  const Mapping* mapping = pick_if(catalog.mappings(), random, [](const Mapping& each) {
    return each.shape->name == "behavior";
  });
  static const std::vector<std::string> contents{"execution_goal: keep_running",
                                                 "start_on_request: FALSE", "reactive_start: TRUE",
                                                 "parameters: []"};
  const std::string& content = random.pick(contents);
  Lines lines = catalog.lines();
  const std::size_t line = add_field(lines, *mapping->item, content);
  return Mutation{lines.text(),
                  {at(lines, "unknown-key", line, mapping->item->column,
                      in_quotes(content.substr(0, content.find(':'))))}};
}

Result task_and_tasks(const CatalogOutline& catalog, Random& random) {
  const Mapping* mapping = pick_if(catalog.mappings(), random, [](const Mapping& each) {
    return each.shape->name == "behavior" && each.item->find("task") != nullptr;
  });
  if (mapping == nullptr) return std::nullopt;
  Lines lines = catalog.lines();
  const std::string name = mapping->item->find("task")->value.text;
  const std::size_t line = add_field(lines, *mapping->item, "tasks:");
  lines.insert_after(line, spaces(mapping->item->column) + "- task: " + name);
  return Mutation{lines.text(), {at(lines, "duplicate-key", line, mapping->item->column)}};
}

}  // namespace

std::vector<MistakeKind> key_mistakes() {
  return {{"required key dropped", drop_key},
          {"required key empty", empty_required_key},
          {"required key misspelt", misspell_required_key},
          {"key misspelt", misspell_optional_key},
          {"strange key", strange_key},
          {"no space after the colon", no_space_after_colon},
          {"key twice", key_twice},
          {"section twice", section_twice},
          {"older name", older_name},
          {"older name and present one", both_names},
          {"key one level up", one_level_up},
          {"key one level down", one_level_down},
          {"key of a task in a behavior", key_of_a_task_in_a_behavior},
          {"task and tasks", task_and_tasks}};
}

}  // namespace cbc::mutation
