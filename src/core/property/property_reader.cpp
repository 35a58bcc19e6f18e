#include "core/property/property_reader.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/property/condition_checks.h"
#include "core/script/names.h"
#include "runtime/base/text.h"

namespace cbc::shape {
namespace {

using yaml::Key;
using yaml::Shape;

constexpr Key file_keys[] = {{"catalog"}, {"assume"}, {"initially"}, {"properties"}};
constexpr Key assumption_keys[] = {{"start"},    {"stop"},     {"successes"},
                                   {"failures"}, {"faults"},   {"situation"},
                                   {"never"},    {"together"}, {"suspended"}};
constexpr Key most_keys[] = {{"most"}};
constexpr Key fault_keys[] = {{"most"}, {"of"}, {"except"}};
constexpr Key property_keys[] = {{"name"},  {"can_start"}, {"priority"},      {"always"},
                                 {"never"}, {"reachable"}, {"keeps_running"}, {"always_possible"},
                                 {"when"},  {"settled"},   {"after"},         {"until"},
                                 {"by"},    {"within"}};
constexpr Key condition_keys[] = {{"running"}, {"stopped"},   {"active"},    {"active_includes"},
                                  {"faulty"},  {"available"}, {"requested"}, {"suspended"},
                                  {"failed"},  {"situation"}, {"not"},       {"any"},
                                  {"all"}};

constexpr const Shape* in_file[] = {&assumptions, &property};
constexpr const Shape* in_assumptions[] = {&faults, &failures, &suspended};
constexpr const Shape* in_property[] = {&condition};

}  // namespace

const Shape property_file{"a property file", file_keys, nullptr, in_file};
const Shape assumptions{"'assume'", assumption_keys, &property_file, in_assumptions};
const Shape faults{"'faults'", fault_keys, &assumptions};
const Shape failures{"'failures'", most_keys, &assumptions};
const Shape suspended{"'suspended'", most_keys, &assumptions};
const Shape property{"a property", property_keys, &property_file, in_property, true, {}, true};
const Shape condition{"a condition", condition_keys, &property, {}, false, {}, true};

}  // namespace cbc::shape

namespace cbc {
namespace {

using yaml::Fields;
using yaml::Kind;
using yaml::Node;

bool is_invariant(Property::Kind kind) {
  return kind == Property::Kind::always || kind == Property::Kind::never;
}

/// A key that belongs to some kinds of properties only.
struct Detail {
  std::string_view key;
  std::string_view owners;  ///< for messages
  bool (*belongs)(Property::Kind kind);
};
constexpr Detail details[] = {
    {"priority", "'can_start'",
     [](Property::Kind kind) { return kind == Property::Kind::can_start; }},
    {"when", "'can_start', 'always', 'keeps_running' and 'always_possible'",
     [](Property::Kind kind) {
       return kind != Property::Kind::never && kind != Property::Kind::reachable;
     }},
    {"settled", "'always', 'never', 'reachable' and 'always_possible'",
     [](Property::Kind kind) {
       return kind != Property::Kind::can_start && kind != Property::Kind::keeps_running;
     }},
    {"after", "'always' and 'never'", is_invariant},
    {"until", "'always' and 'never'", is_invariant},
    {"by", "'keeps_running' and 'always_possible'",
     [](Property::Kind kind) {
       return kind == Property::Kind::keeps_running || kind == Property::Kind::always_possible;
     }},
    {"within", "'always_possible'",
     [](Property::Kind kind) { return kind == Property::Kind::always_possible; }}};

bool belongs(std::string_view key, Property::Kind kind) {
  return std::all_of(std::begin(details), std::end(details), [&](const Detail& detail) {
    return detail.key != key || detail.belongs(kind);
  });
}

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
                       "a property needs one of 'can_start', 'always', 'never', 'reachable', "
                       "'keeps_running' and 'always_possible'");
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
    if (property.kind == Property::Kind::can_start ||
        property.kind == Property::Kind::keeps_running) {
      const auto task = property.kind == Property::Kind::can_start
                            ? names_.find_requestable(value, key, reporter_)
                            : names_.find_task(value, key, reporter_);
      if (task) property.task = names_.catalog().task_ids[*task];
    } else {
      const bool is_denied = property.kind == Property::Kind::never;
      property.condition = read_condition(value, key, is_denied);
    }
    if (const Node* priority = fields.find("priority")) {
      property.priority = yaml::read_integer(*priority, "priority", 1, reporter_).value_or(1);
    }
    property.when = read_part(fields, "when", property.kind);
    property.after = read_part(fields, "after", property.kind);
    property.until = read_part(fields, "until", property.kind);
    if (property.until && !property.after) {
      reporter_.report(rule::missing_key, fields.range_of("until"),
                       "'until' needs 'after', which says where the promise begins");
    }
    if (const Node* settled = fields.find("settled")) {
      property.settled = yaml::read_boolean(*settled, "settled", reporter_).value_or(false);
    }
    if (const Node* by = fields.find("by")) property.by = read_by(*by);
    if (const Node* within = fields.find("within")) {
      const auto most = yaml::read_integer(*within, "within", 0, reporter_);
      if (most) property.within = static_cast<std::uint32_t>(*most);
    }
  }

  /// Where the key does not belong, that is reported already.
  std::optional<StateCondition> read_part(const Fields& fields, std::string_view key,
                                          Property::Kind kind) {
    const Node* node = fields.find(key);
    if (node == nullptr || !belongs(key, kind)) return std::nullopt;
    return read_condition(*node, key, false);
  }

  /// `is_denied`: see ConditionChecks.
  StateCondition read_condition(const Node& node, std::string_view what, bool is_denied) {
    const std::size_t errors = reporter_.errors();
    StateCondition condition = cbc::read_condition(node, what, names_, reporter_);
    if (reporter_.errors() > errors) return {};
    if (!checks_) checks_.emplace(names_.catalog(), assumptions_);
    checks_->check(condition, is_denied, reporter_);
    return condition;
  }

  MoveKinds read_by(const Node& node) {
    MoveKinds kinds;
    constexpr std::string_view expected =
        "a list of kinds of moves: 'start', 'stop', 'successes', 'failures', 'fault', 'repair', "
        "'situation' and 'queue'";
    if (yaml::read_list(node, "by", expected, reporter_) == nullptr) return kinds;
    if (node.items.empty()) {
      reporter_.report(rule::invalid_value, node.range,
                       concat("'by' must be ", expected, ", found an empty list"));
    }
    ListedNames listed;
    for (const Node* item : node.items) {
      if (item->kind == Kind::mapping) {
        for (const auto& [key, value] : item->entries) {
          read_kind_of_tasks(*key, *value, listed, kinds);
        }
      } else {
        static_cast<void>(read_kind_of_moves(*item, expected, listed, kinds));
      }
    }
    return kinds;
  }

  /// Whether the node is a kind that was not listed before, which is added.
  bool read_kind_of_moves(const Node& node, std::string_view expected, ListedNames& listed,
                          MoveKinds& kinds) {
    const auto* const found = std::find_if(
        move_kind_words.begin(), move_kind_words.end(),
        [&](const auto& known) { return node.kind == Kind::scalar && known.word == node.text; });
    if (found == move_kind_words.end()) {
      reporter_.report(rule::invalid_value, node.range,
                       concat("'by' must be ", expected, ", found ", yaml::describe(node)));
      return false;
    }
    kinds.*(found->kind) = true;
    return listed.add(static_cast<std::uint32_t>(found - move_kind_words.begin()), node, reporter_);
  }

  /// `start: [TASK]`
  void read_kind_of_tasks(const Node& key, const Node& value, ListedNames& listed,
                          MoveKinds& kinds) {
    if (!read_kind_of_moves(key, "'start' or 'stop' with a list of tasks", listed, kinds)) return;
    if (key.text != "start" && key.text != "stop") {
      reporter_.report(rule::invalid_value, key.range,
                       concat("only 'start' and 'stop' of 'by' take tasks, not ", quote(key.text)));
      return;
    }
    const bool is_start = key.text == "start";
    if (yaml::read_list(value, key.text, "a list of tasks", reporter_) == nullptr) return;
    if (value.items.empty()) {
      reporter_.report(rule::invalid_value, value.range,
                       concat(quote(key.text), " must be a list of tasks, found an empty list"));
    }
    ListedNames tasks;
    for (const Node* item : value.items) {
      const auto task = names_.find_task(*item, key.text, reporter_, &value);
      if (!task || !tasks.add(*task, *item, reporter_)) continue;
      const TaskId id = names_.catalog().task_ids[*task];
      (is_start ? kinds.start_only : kinds.stop_only).push_back(id);
      check_is_assumed(id, is_start, *item);
    }
  }

  void check_is_assumed(TaskId task, bool is_start, const Node& node) {
    if (assumptions_ == nullptr) return;
    const auto& stopped = assumptions_->stop;
    const bool is_assumed =
        is_start ? std::any_of(assumptions_->start.begin(), assumptions_->start.end(),
                               [task](const auto& start) { return start.task == task; })
                 : std::find(stopped.begin(), stopped.end(), task) != stopped.end();
    if (is_assumed) return;
    const char* const word = is_start ? "start" : "stop";
    reporter_.report_as({Severity::warning}, rule::impossible_expectation, node.range,
                        concat("no such move is made, as ", quote(word),
                               " of 'assume' does not list task ", quote(node.text)));
  }

  NameIndex names_;
  Reporter& reporter_;
  const Assumptions* assumptions_ = nullptr;  ///< null if they have mistakes
  std::optional<ConditionChecks> checks_;     ///< made for the first condition
};

}  // namespace

std::vector<const StateCondition*> conditions_of(const Property& property) {
  std::vector<const StateCondition*> conditions;
  const auto add = [&conditions](const StateCondition& part) { conditions.push_back(&part); };
  for_each_condition(property.condition, add);
  for (const auto* part : {&property.when, &property.after, &property.until}) {
    if (*part) for_each_condition(**part, add);
  }
  return conditions;
}

std::set<std::uint32_t> variables_of(const Property& property) {
  std::set<std::uint32_t> variables;
  for (const StateCondition* condition : conditions_of(property)) {
    if (condition->variable != none) variables.insert(condition->variable);
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
