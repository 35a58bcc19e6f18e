#include "core/property/property_reader.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/script/names.h"
#include "runtime/base/text.h"

namespace cbc::shape {
namespace {

using yaml::Key;
using yaml::Shape;

constexpr Key file_keys[] = {{"catalog"}, {"assume"}, {"initially"}, {"properties"}};
constexpr Key assumption_keys[] = {{"start"},  {"stop"},      {"successes"}, {"failures"},
                                   {"faults"}, {"situation"}, {"never"},     {"together"}};
constexpr Key fault_keys[] = {{"most"}, {"of"}, {"except"}};
constexpr Key property_keys[] = {{"name"},  {"can_start"}, {"priority"}, {"always"},
                                 {"never"}, {"reachable"}, {"when"},     {"settled"}};
constexpr Key condition_keys[] = {{"running"}, {"stopped"},   {"active"},    {"active_includes"},
                                  {"faulty"},  {"available"}, {"requested"}, {"situation"}};

constexpr const Shape* in_file[] = {&assumptions, &property};
constexpr const Shape* in_assumptions[] = {&faults};
constexpr const Shape* in_property[] = {&condition};

}  // namespace

const Shape property_file{"a property file", file_keys, nullptr, in_file};
const Shape assumptions{"an assume", assumption_keys, &property_file, in_assumptions};
const Shape faults{"a faults", fault_keys, &assumptions};
const Shape property{"a property", property_keys, &property_file, in_property, true};
const Shape condition{"a condition", condition_keys, &property};

}  // namespace cbc::shape

namespace cbc {
namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

/// A key that belongs to some kinds of properties only.
struct Detail {
  std::string_view key;
  std::string_view owners;  ///< for messages
  bool (*belongs)(Property::Kind kind);
};
constexpr Detail details[] = {
    {"priority", "'can_start'",
     [](Property::Kind kind) { return kind == Property::Kind::can_start; }},
    {"when", "'always'", [](Property::Kind kind) { return kind == Property::Kind::always; }},
    {"settled", "'always', 'never' and 'reachable'",
     [](Property::Kind kind) { return kind != Property::Kind::can_start; }}};

class PropertyReader {
 public:
  PropertyReader(const CompiledCatalog& catalog, std::vector<NamePlace>* names, Reporter& reporter)
      : names_(catalog, names), reporter_(reporter) {}

  void read(const Node& root, PropertyFile& file) {
    Fields fields(root, shape::property_file, reporter_);
    if (const Node* catalog = fields.find("catalog")) {
      const auto name = yaml::read_name(*catalog, "catalog", "the path of a catalog", reporter_);
      if (name) file.catalog = *name;
    }
    const std::size_t errors = reporter_.errors();
    file.assumptions = read_assumptions(fields.find("assume"), fields.find("initially"),
                                        !fields.has_unknown(), names_, reporter_);
    // What follows from a mistake is not reported.
    if (reporter_.errors() == errors && !fields.has_unknown()) assumptions_ = &file.assumptions;
    if (const Node* properties = fields.find("properties")) {
      read_list(*properties, file.properties);
    } else if (!fields.has_unknown()) {
      reporter_.report_as({Severity::note, true}, rule::missing_key, root.range,
                          "without 'properties' there is nothing to prove");
    }
    fields.report_unknown(yaml::UnknownKeys::refused);
  }

 private:
  void read_list(const Node& node, std::vector<Property>& properties) {
    if (yaml::read_list(node, "properties", "a list of properties", reporter_) == nullptr) return;
    for (const Node* item : node.items) properties.push_back(read_property(*item));
  }

  Property read_property(const Node& node) {
    Property property;
    property.line = node.range.begin.line;
    if (node.kind != Kind::mapping) {
      reporter_.report(
          rule::wrong_type, node.range,
          "a property must be a mapping ('can_start: TASK'), found " + yaml::describe(node));
      return property;
    }
    Fields fields(node, shape::property, reporter_);
    if (const Node* name = fields.find("name")) {
      property.name = yaml::read_name(*name, "name", "a text", reporter_).value_or("");
    }
    if (const auto kind = find_kind(fields, node.range)) {
      property.kind = *kind;
      report_misplaced(fields, *kind);
      read_kind(fields, property);
    }
    fields.report_unknown(yaml::UnknownKeys::refused);
    return property;
  }

  std::optional<Property::Kind> find_kind(const Fields& fields, const Range& range) {
    const yaml::ChosenKey chosen = yaml::choose_key(
        fields, property_kinds, "a property must be of exactly one kind", reporter_);
    if (!chosen.name.empty()) {
      const auto* const found =
          std::find(property_kinds.begin(), property_kinds.end(), chosen.name);
      return static_cast<Property::Kind>(found - property_kinds.begin());
    }
    if (chosen.is_reported) return std::nullopt;
    // An unknown key is probably the kind, misspelt.
    if (!chosen.without_value.empty()) {
      reporter_.report(rule::missing_key, fields.range_of(chosen.without_value),
                       quote(chosen.without_value) + " has no value");
    } else if (!fields.has_unknown()) {
      reporter_.report(rule::missing_key, range,
                       "a property needs one of 'can_start', 'always', 'never' and 'reachable'");
    }
    return std::nullopt;
  }

  void report_misplaced(const Fields& fields, Property::Kind kind) {
    for (const Detail& detail : details) {
      if (fields.find(detail.key) == nullptr || detail.belongs(kind)) continue;
      reporter_.report_as({Severity::error, true}, rule::unknown_key, fields.range_of(detail.key),
                          concat(quote(detail.key), " does not belong to ", quote(name_of(kind)),
                                 ", only to ", detail.owners));
    }
  }

  void read_kind(const Fields& fields, Property& property) {
    const std::string_view key = name_of(property.kind);
    const Node& value = *fields.find(key);
    if (property.kind == Property::Kind::can_start) {
      const auto task = names_.find_task(value, key, reporter_);
      if (task) property.task = names_.catalog().task_ids[*task];
      if (const Node* priority = fields.find("priority")) {
        property.priority = yaml::read_integer(*priority, "priority", 1, reporter_).value_or(1);
      }
      return;
    }
    const bool is_denied = property.kind == Property::Kind::never;
    property.condition = read_condition(value, key, {assumptions_, is_denied}, names_, reporter_);
    const Node* when = fields.find("when");
    if (when != nullptr && property.kind == Property::Kind::always) {
      property.when = read_condition(*when, "when", {assumptions_, false}, names_, reporter_);
    }
    if (const Node* settled = fields.find("settled")) {
      property.settled = yaml::read_boolean(*settled, "settled", reporter_).value_or(false);
    }
  }

  NameIndex names_;
  Reporter& reporter_;
  const Assumptions* assumptions_ = nullptr;  ///< null if they have mistakes
};

}  // namespace

std::set<std::uint32_t> variables_of(const Property& property) {
  std::set<std::uint32_t> variables;
  for (const VariableValue& value : property.condition.situation.variables) {
    variables.insert(value.variable);
  }
  if (!property.when) return variables;
  for (const VariableValue& value : property.when->situation.variables) {
    variables.insert(value.variable);
  }
  return variables;
}

std::optional<PropertyFile> read_properties(const yaml::Document& document,
                                            const CompiledCatalog& catalog,
                                            Diagnostics& diagnostics,
                                            std::vector<NamePlace>* names) {
  Reporter reporter(document.file(), diagnostics);
  PropertyFile file;
  file.path = document.file();
  const Node& root = document.root();
  switch (root.kind) {
    case Kind::null:
      reporter.report(rule::missing_key, root.range,
                      "missing key 'properties': the property file is empty");
      break;
    case Kind::mapping:
      PropertyReader(catalog, names, reporter).read(root, file);
      break;
    case Kind::scalar:
    case Kind::sequence:
      reporter.report(rule::wrong_type, root.range,
                      "a property file must be a mapping with the key 'properties', found " +
                          yaml::describe(root));
      break;
  }
  if (reporter.errors() > 0) return std::nullopt;
  return file;
}

bool lacks_properties(const yaml::Document& document, const PropertyFile& file) {
  return file.properties.empty() && yaml::stands_in(document.root(), "properties");
}

}  // namespace cbc
