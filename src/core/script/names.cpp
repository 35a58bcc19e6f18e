#include "core/script/names.h"

#include <string>
#include <utility>
#include <vector>

#include "cbc/event.h"
#include "core/catalog/situation.h"
#include "core/diagnostic/rules.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

Suggestions& suggestions_from(const Texts& names, std::optional<Suggestions>& made) {
  if (!made) {
    std::vector<std::string_view> all;
    all.reserve(names.size());
    // NOLINTNEXTLINE(modernize-loop-convert): these texts have no iterators
    for (std::size_t place = 0; place < names.size(); ++place) all.push_back(names[place]);
    made.emplace(std::move(all));
  }
  return *made;
}

// The name is unknown as a `kind`, but may be known as another.
std::string describe_unknown(std::string_view name, std::string_view kind, bool is_other,
                             std::string_view other, Suggestions& suggestions,
                             const yaml::Node* beside) {
  std::string message = "there is no " + std::string(kind) + " " + quote(name);
  if (is_other) message += ": it is a " + std::string(other);
  const auto is_taken = [beside](std::string_view known) {
    return beside != nullptr && yaml::stands_in(*beside, known);
  };
  message += did_you_mean(suggestions.nearest(name, is_taken));
  return message;
}

}  // namespace

std::optional<std::uint32_t> NameIndex::find_task(const yaml::Node& node, std::string_view what,
                                                  Reporter& reporter, const yaml::Node* beside) {
  const auto name = yaml::read_name(node, what, "the name of a task", reporter);
  if (!name) return std::nullopt;
  const auto found = catalog_.find_task(*name);
  if (found) {
    note(NameKind::task, node);
  } else {
    reporter.report(
        rule::undefined_task, node.range,
        describe_unknown(*name, "task", catalog_.find_behavior(*name).has_value(), "behavior",
                         suggestions_from(catalog_.task_names, tasks_), beside));
  }
  return found;
}

std::optional<std::uint32_t> NameIndex::find_requestable(const yaml::Node& node,
                                                         std::string_view what, Reporter& reporter,
                                                         const yaml::Node* beside) {
  const auto task = find_task(node, what, reporter, beside);
  if (task && catalog_.rules_of(catalog_.task_ids[*task]).requestable == 0) {
    reporter.report(rule::invalid_value, node.range,
                    concat("task ", quote(catalog_.task_names[*task]),
                           " cannot be requested: the catalog says 'requestable: false'"));
  }
  return task;
}

std::optional<std::uint32_t> NameIndex::find_behavior(const yaml::Node& node, std::string_view what,
                                                      Reporter& reporter,
                                                      const yaml::Node* beside) {
  const auto name = yaml::read_name(node, what, "the name of a behavior", reporter);
  if (!name) return std::nullopt;
  const auto found = catalog_.find_behavior(*name);
  if (found) {
    note(NameKind::behavior, node);
    return found;
  }
  const bool is_task = catalog_.find_task(*name).has_value();
  std::string message =
      is_task && what == cbc::name_of(Verb::finish)
          ? concat("there is no behavior ", quote(*name), ": it is a task; write ",
                   quote(concat("finish: {task: ", *name, "}")),
                   " for the behavior that performs it")
          : describe_unknown(*name, "behavior", is_task, "task",
                             suggestions_from(catalog_.behavior_names, behaviors_), beside);
  reporter.report(rule::undefined_behavior, node.range, std::move(message));
  return std::nullopt;
}

std::optional<NameIndex::Part> NameIndex::find_part(const yaml::Node& node, Reporter& reporter,
                                                    const yaml::Node* beside) {
  const auto name =
      yaml::read_name(node, "situation", "the name of a behavior or a variable", reporter);
  if (!name) return std::nullopt;
  if (const auto part = part_called(*name, node)) return part;
  if (!parts_) {
    std::vector<std::string_view> names;
    for (const std::string_view behavior : catalog_.behavior_names) names.push_back(behavior);
    for (std::uint32_t variable = 0; variable < catalog_.variables.size(); ++variable) {
      names.push_back(catalog_.name_of_variable(variable));
    }
    parts_.emplace(std::move(names));
  }
  const bool has_variables = !catalog_.variables.empty();
  reporter.report(
      has_variables ? rule::undeclared_situation : rule::undefined_behavior, node.range,
      describe_unknown(*name, has_variables ? "behavior or situation variable" : "behavior",
                       catalog_.find_task(*name).has_value(), "task", *parts_, beside));
  return std::nullopt;
}

StateAsk& NameIndex::states() {
  if (states_ == nullptr) {
    states_ = std::make_unique<StateAsk>(catalog_, PossibleStates{}, most_effort_of_assignments);
  }
  return *states_;
}

void NameIndex::pass_part(const yaml::Node& node) { (void)part_called(node.text, node); }

std::optional<NameIndex::Part> NameIndex::part_called(std::string_view name,
                                                      const yaml::Node& node) {
  if (const auto variable = catalog_.find_variable(name)) {
    note(NameKind::variable, node);
    return Part{true, *variable};
  }
  if (const auto behavior = catalog_.find_behavior(name)) {
    note(NameKind::behavior, node);
    return Part{false, *behavior};
  }
  return std::nullopt;
}

namespace {

std::optional<VariableValue> read_value(std::uint32_t variable, const yaml::Node& node,
                                        NameIndex& names, Reporter& reporter) {
  const CompiledCatalog& catalog = names.catalog();
  const auto text = value_text(node, catalog.variables[variable].is_boolean != 0);
  const auto value = text ? catalog.find_value(variable, *text) : std::nullopt;
  if (value) return VariableValue{variable, *value};
  std::vector<std::string_view> values;
  for (std::uint32_t place = 0; place < catalog.variables[variable].value_count; ++place) {
    values.push_back(catalog.name_of_value({variable, place}));
  }
  report_unknown_value(node, catalog.name_of_variable(variable), values, reporter);
  return std::nullopt;
}

/// One value, or any of a list.
std::vector<std::uint32_t> read_values(std::uint32_t variable, const yaml::Node& node,
                                       NameIndex& names, Reporter& reporter) {
  const std::vector<const yaml::Node*> single{&node};
  const bool is_list = node.kind == yaml::Kind::sequence;
  if (is_list && node.items.empty()) {
    yaml::report_wrong_type(node, names.catalog().name_of_variable(variable),
                            "a value of the situation variable or a list of some", reporter);
  }
  std::vector<std::uint32_t> values;
  ListedNames listed;
  bool is_understood = true;
  for (const yaml::Node* item : is_list ? node.items : single) {
    const auto read = read_value(variable, *item, names, reporter);
    is_understood &= read && listed.add(read->value, *item, reporter);
    if (read) values.push_back(read->value);
  }
  if (!is_understood) values.clear();
  return values;
}

/// `takes_lists`: of the values of a variable.
std::optional<std::vector<SituationEntry>> read_entries(const yaml::Node& node, bool takes_lists,
                                                        NameIndex& names, Reporter& reporter) {
  constexpr std::string_view expected =
      "a mapping of behaviors to true or false, or of situation variables to values";
  if (yaml::read_mapping(node, "situation", expected, reporter) == nullptr) return std::nullopt;
  yaml::report_duplicate_keys(node, reporter);
  std::vector<SituationEntry> entries;
  bool is_understood = true;
  for (const auto& [key, value] : node.entries) {
    if (value->kind == yaml::Kind::null) {
      names.pass_part(*key);
      continue;
    }
    const auto part = names.find_part(*key, reporter, &node);
    SituationEntry entry;
    entry.range = key->range;
    bool is_valid = false;
    if (part && part->is_variable) {
      if (takes_lists) {
        entry.values = read_values(part->place, *value, names, reporter);
      } else if (const auto read = read_value(part->place, *value, names, reporter)) {
        entry.values.push_back(read->value);
      }
      is_valid = !entry.values.empty();
    } else if (part) {
      // The value of an unknown name may be one of a variable, which the catalog lacks.
      const auto available = yaml::read_boolean(*value, key->text, reporter);
      entry.available = available.value_or(true);
      is_valid = available.has_value();
    }
    is_understood &= is_valid;
    if (!is_valid) continue;
    entry.part = *part;
    entries.push_back(std::move(entry));
  }
  return is_understood ? std::optional(std::move(entries)) : std::nullopt;
}

}  // namespace

bool ListedNames::add(std::uint32_t place, const yaml::Node& node, Reporter& reporter) {
  const auto [first, is_new] = first_.try_emplace(place, node.range);
  if (!is_new) {
    reporter.report(rule::invalid_value, node.range, quote(node.text) + " is listed twice",
                    {reporter.note(first->second, "first listed here")});
  }
  return is_new;
}

std::optional<Situation> read_situation(const yaml::Node& node, NameIndex& names,
                                        Reporter& reporter) {
  const auto entries = read_entries(node, false, names, reporter);
  if (!entries) return std::nullopt;
  Situation situation;
  for (const SituationEntry& entry : *entries) {
    if (entry.part.is_variable) {
      situation.variables.push_back({entry.part.place, entry.values.front()});
    } else {
      situation.availability.push_back({entry.part.place, entry.available});
    }
  }
  return situation;
}

std::optional<std::vector<SituationEntry>> read_possible_situation(const yaml::Node& node,
                                                                   NameIndex& names,
                                                                   Reporter& reporter) {
  return read_entries(node, true, names, reporter);
}

}  // namespace cbc
