#include "condition_text.h"

#include <algorithm>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/property/property_reader.h"
#include "core/yaml/document.h"
#include "core/yaml/source.h"

namespace cbc::plain {
namespace {

using yaml::in_quotes;

class Writer {
 public:
  explicit Writer(const CompiledCatalog& catalog) : catalog_(catalog) {}

  [[nodiscard]] std::string condition(const StateCondition& condition) const {
    std::vector<std::string> parts;
    const auto add = [&parts](const std::string& key, const std::string& value) {
      parts.push_back(key + ": " + value);
    };
    if (!condition.running.empty()) {
      std::vector<std::string> entries;
      for (const auto& entry : condition.running) {
        entries.push_back(task(entry.task) + ": " +
                          (entry.behaviors.empty() ? "any" : behaviors(entry.behaviors)));
      }
      add("running", map_of(entries));
    }
    if (!condition.stopped.empty()) {
      std::vector<std::string> tasks;
      for (const TaskId one : condition.stopped) tasks.push_back(task(one));
      add("stopped", list_of(tasks));
    }
    if (!condition.active.empty() || condition.only_active) {
      add(condition.only_active ? "active" : "active_includes", behaviors(condition.active));
    }
    if (!condition.faulty.empty()) add("faulty", behaviors(condition.faulty));
    if (!condition.available.empty()) add("available", behaviors(condition.available));
    if (!condition.requested.empty()) {
      std::vector<std::string> entries;
      for (const auto& entry : condition.requested) {
        entries.push_back(task(entry.task) + ": " + std::to_string(entry.priority));
      }
      add("requested", map_of(entries));
    }
    if (const std::vector<std::string> entries = situation(condition); !entries.empty()) {
      add("situation", map_of(entries));
    }
    for (const StateCondition& part : condition.negated) add("not", this->condition(part));
    if (!condition.any.empty()) add("any", list_of(conditions(condition.any)));
    std::vector<std::string> all = conditions(condition.all);
    // With a list of faulty behaviors it needs a mapping of its own.
    if (condition.none_faulty) all.emplace_back("{faulty: none}");
    if (!all.empty()) add("all", list_of(all));
    return map_of(parts);
  }

  [[nodiscard]] std::string task(TaskId task) const {
    return in_quotes(catalog_.name_of_task(task));
  }

  [[nodiscard]] std::string kinds(const MoveKinds& kinds) const {
    std::vector<std::string> words;
    for (const MoveKindWord& known : move_kind_words) {
      if (!(kinds.*known.kind)) continue;
      std::vector<std::string> only;
      const bool is_start = known.kind == &MoveKinds::start;
      if (is_start || known.kind == &MoveKinds::stop) {
        for (const TaskId one : is_start ? kinds.start_only : kinds.stop_only) {
          only.push_back(task(one));
        }
      }
      const std::string word(known.word);
      words.push_back(only.empty() ? word : word + ": " + list_of(only));
    }
    return list_of(words);
  }

 private:
  [[nodiscard]] static std::string joined(const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + text;
    return all;
  }
  [[nodiscard]] static std::string map_of(const std::vector<std::string>& entries) {
    return "{" + joined(entries) + "}";
  }
  [[nodiscard]] static std::string list_of(const std::vector<std::string>& items) {
    return "[" + joined(items) + "]";
  }

  [[nodiscard]] std::string behaviors(const std::vector<BehaviorId>& behaviors) const {
    std::vector<std::string> names;
    names.reserve(behaviors.size());
    for (const BehaviorId one : behaviors) {
      names.push_back(in_quotes(catalog_.name_of_behavior(one)));
    }
    return list_of(names);
  }
  [[nodiscard]] std::vector<std::string> conditions(
      const std::vector<StateCondition>& conditions) const {
    std::vector<std::string> texts;
    texts.reserve(conditions.size());
    for (const StateCondition& part : conditions) texts.push_back(condition(part));
    return texts;
  }
  [[nodiscard]] std::vector<std::string> situation(const StateCondition& condition) const {
    std::vector<std::string> entries;
    for (const auto& entry : condition.variables) {
      std::vector<std::string> values;
      for (const std::uint32_t value : entry.values) {
        values.push_back(in_quotes(catalog_.name_of_value({entry.variable, value})));
      }
      entries.push_back(in_quotes(catalog_.name_of_variable(entry.variable)) + ": " +
                        (values.size() == 1 ? values.front() : list_of(values)));
    }
    for (const auto& entry : condition.own) {
      entries.push_back(in_quotes(catalog_.name_of_behavior(entry.behavior)) + ": " +
                        (entry.available ? "true" : "false"));
    }
    return entries;
  }

  const CompiledCatalog& catalog_;
};

std::optional<PropertyFile> read(const CompiledCatalog& catalog, const Property& property,
                                 Diagnostics& diagnostics) {
  const auto document =
      yaml::parse("properties:\n- " + yaml_of(catalog, property), "p.yaml", diagnostics);
  return document == nullptr ? std::nullopt : read_properties(*document, catalog, diagnostics);
}

}  // namespace

std::string yaml_of(const CompiledCatalog& catalog, const Property& property) {
  const Writer writer(catalog);
  std::string text = "{name: " + property.name + ", " + std::string(name_of(property.kind)) + ": ";
  if (property.kind == Property::Kind::can_start) {
    text += writer.task(property.task) + ", priority: " + std::to_string(property.priority);
  } else if (property.kind == Property::Kind::keeps_running) {
    text += writer.task(property.task);
  } else {
    text += writer.condition(property.condition);
  }
  if (property.when) text += ", when: " + writer.condition(*property.when);
  if (property.after) text += ", after: " + writer.condition(*property.after);
  if (property.until) text += ", until: " + writer.condition(*property.until);
  if (property.within) text += ", within: " + std::to_string(*property.within);
  if (property.by) text += ", by: " + writer.kinds(*property.by);
  return text + (property.settled ? ", settled: true}" : "}");
}

std::optional<Property> read_again(const CompiledCatalog& catalog, const Property& property) {
  Diagnostics diagnostics;
  const auto file = read(catalog, property, diagnostics);
  if (!file || file->properties.size() != 1) return std::nullopt;
  return file->properties.front();
}

bool is_called_impossible(const CompiledCatalog& catalog, const StateCondition& condition) {
  Property property;
  property.kind = Property::Kind::reachable;
  property.name = "P";
  property.condition = condition;
  Diagnostics diagnostics;
  if (read(catalog, property, diagnostics)) return false;
  const auto& all = diagnostics.all();
  // Other mistakes come first: what is listed twice, say.
  return std::all_of(all.begin(), all.end(), [](const Diagnostic& finding) {
    return finding.severity != Severity::error || finding.rule == rule::impossible_expectation.name;
  });
}

}  // namespace cbc::plain
