#include <algorithm>

#include "lint_mutations.h"

namespace cbc::mutation {
namespace {

using Result = std::optional<Mutation>;

constexpr std::string_view yaml_syntax = "yaml-syntax";

/// A field with a plain value on its line.
std::optional<PlacedField> pick_scalar(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* found = pick_if(fields, random, [&](const PlacedField& placed) {
    const Item& value = placed.field->value;
    if (value.kind != Item::Kind::scalar) return false;
    const char first = catalog.lines()[value.line][value.column];
    return first != '"' && first != '\'';
  });
  return found == nullptr ? std::nullopt : std::optional(*found);
}

/// The next line after `line` with content, or the one past the last.
std::size_t next_content(const Lines& lines, std::size_t line) {
  ++line;
  while (line <= lines.count() && !lines.has_content(line)) ++line;
  return line;
}

std::set<std::size_t> lines_from(std::size_t first, std::size_t last) {
  std::set<std::size_t> all;
  for (std::size_t line = first; line <= last; ++line) all.insert(line);
  return all;
}

Result open_quote(const CatalogOutline& catalog, Random& random) {
  const auto placed = pick_scalar(catalog, random);
  if (!placed) return std::nullopt;
  Lines lines = catalog.lines();
  const Item& value = placed->field->value;
  const char quote = random.percent(50) ? '"' : '\'';
  // Another one further down would end it.
  for (std::size_t line = value.line; line <= lines.count(); ++line) {
    if (lines[line].find(quote) != std::string::npos) return std::nullopt;
  }
  lines.replace(value.line, value.column, 0, std::string(1, quote));
  return Mutation{lines.text(), {at(lines, yaml_syntax, value.line, value.column)}};
}

Result tab_indents(const CatalogOutline& catalog, Random& random) {
  const auto placed = pick_scalar(catalog, random);
  if (!placed || placed->field->column < 2) return std::nullopt;
  Lines lines = catalog.lines();
  const std::size_t line = placed->field->line;
  const std::size_t indentation = lines[line].find_first_not_of(' ');
  if (indentation < 2) return std::nullopt;
  lines.replace(line, 0, indentation, "\t");
  return Mutation{lines.text(), {at(lines, yaml_syntax, line, 0, "tab")}};
}

Result open_bracket(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return each.field->value.flow && !each.field->value.items.empty();
  });
  if (placed == nullptr) return std::nullopt;
  Lines lines = catalog.lines();
  const std::size_t line = placed->field->line;
  const std::size_t bracket = lines[line].find(']', placed->field->value.column);
  lines.replace(line, bracket, 1, "");
  // The list may go on until something that cannot stand in it.
  const std::size_t next = next_content(lines, line);
  const std::size_t last = next > lines.count() ? lines.count() + 1 : next;
  return Mutation{lines.text(), {{yaml_syntax, lines_from(line, last), std::nullopt}}};
}

/// A key that stands one column further to the right than those of its mapping.
Result too_deep(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    if (each.field == each.mapping->fields.data()) return false;
    // After a key whose value is a list, a line further to the right belongs to that list.
    return (each.field - 1)->value.kind == Item::Kind::scalar;
  });
  if (placed == nullptr) return std::nullopt;
  Lines lines = catalog.lines();
  const std::size_t line = placed->field->line;
  lines.replace(line, 0, 0, " ");
  return Mutation{lines.text(), {{yaml_syntax, {line}, std::nullopt}}};
}

/// A key one column further to the left, where no mapping is.
Result too_shallow(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return each.field != each.mapping->fields.data() && each.mapping->column >= 2;
  });
  if (placed == nullptr) return std::nullopt;
  Lines lines = catalog.lines();
  const std::size_t line = placed->field->line;
  lines.replace(line, 0, 1, "");
  return Mutation{lines.text(), {{yaml_syntax, {line}, std::nullopt}}};
}

Result second_document(const CatalogOutline& catalog, Random& random) {
  const Field* section = pick_if(catalog.root().fields, random, [&](const Field& field) {
    return &field != catalog.root().fields.data();
  });
  if (section == nullptr) return std::nullopt;
  Lines lines = catalog.lines();
  lines.insert_after(section->line - 1, "---");
  return Mutation{lines.text(), {at(lines, yaml_syntax, section->line, 0, "second")}};
}

Result bad_value(const CatalogOutline& catalog, Random& random) {
  const auto placed = pick_scalar(catalog, random);
  if (!placed) return std::nullopt;
  static const std::vector<std::string> values{"*UNKNOWN", "@here",  "one: two", "%half",
                                               "a\x01z",   "a\xFFz", "!thing x", "[A]]"};
  Lines lines = catalog.lines();
  set_value(lines, *placed->field, random.pick(values));
  return Mutation{lines.text(), {{yaml_syntax, {placed->field->line}, std::nullopt}}};
}

Result no_colon(const CatalogOutline& catalog, Random& random) {
  const auto placed = pick_scalar(catalog, random);
  if (!placed || placed->mapping->fields.size() < 2) return std::nullopt;
  const Field& field = *placed->field;
  if (field.line == catalog.root().last_line) return std::nullopt;
  Lines lines = catalog.lines();
  lines.replace(field.line, field.column + field.key.size(), 1, "");
  return Mutation{lines.text(), {at(lines, yaml_syntax, field.line, field.column, "':' missing")}};
}

}  // namespace

std::vector<MistakeKind> syntax_mistakes() {
  return {{"open quote", open_quote},
          {"tab indents", tab_indents},
          {"open bracket", open_bracket},
          {"indented too far", too_deep},
          {"indented too little", too_shallow},
          {"second document", second_document},
          {"bad value", bad_value},
          {"no colon", no_colon}};
}

}  // namespace cbc::mutation
