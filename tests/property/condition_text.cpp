#include "condition_text.h"

#include <algorithm>
#include <map>
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

  /// `condition`: all of its parts.
  [[nodiscard]] std::string condition(const StateCondition& condition) const {
    std::map<std::string, std::vector<std::string>> lists;
    std::map<std::string, std::vector<std::string>> maps;
    std::vector<std::string> parts;
    for (const StateCondition& part : condition.parts) {
      switch (part.kind) {
        case Kind::running:
          maps["running"].push_back(task(part.task) + ": " +
                                    (part.behaviors.empty() ? "any" : behaviors(part.behaviors)));
          break;
        case Kind::stopped:
          lists["stopped"].push_back(task(part.task));
          break;
        case Kind::active:
          lists["active_includes"].push_back(behavior(part.behavior));
          break;
        case Kind::only_active: {
          std::vector<BehaviorId> listed;
          for (const StateCondition& active : part.parts) listed.push_back(active.behavior);
          parts.push_back("active: " + behaviors(listed));
          break;
        }
        case Kind::faulty:
          lists["faulty"].push_back(behavior(part.behavior));
          break;
        case Kind::failed:
          lists["failed"].push_back(behavior(part.behavior));
          break;
        case Kind::suspended:
          lists["suspended"].push_back(task(part.task));
          break;
        case Kind::available:
          lists["available"].push_back(behavior(part.behavior));
          break;
        case Kind::requested:
          maps["requested"].push_back(task(part.task) + ": " + std::to_string(part.priority));
          break;
        case Kind::variable:
        case Kind::own:
          maps["situation"].push_back(situation(part));
          break;
        case Kind::negated:
          parts.push_back("not: " + this->condition(part.parts.front()));
          break;
        case Kind::any:
          parts.push_back("any: " + list_of(conditions(part.parts)));
          break;
        case Kind::all:
          for (const StateCondition& inner : part.parts)
            lists["all"].push_back(this->condition(inner));
          break;
        case Kind::none_faulty:
          // With a list of faulty behaviors it needs a mapping of its own.
          lists["all"].emplace_back("{faulty: none}");
          break;
      }
    }
    for (const auto& [key, items] : lists) parts.push_back(key + ": " + list_of(items));
    for (const auto& [key, entries] : maps) parts.push_back(key + ": " + map_of(entries));
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
  using Kind = StateCondition::Kind;

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

  [[nodiscard]] std::string behavior(BehaviorId behavior) const {
    return in_quotes(catalog_.name_of_behavior(behavior));
  }
  [[nodiscard]] std::string behaviors(const std::vector<BehaviorId>& behaviors) const {
    std::vector<std::string> names;
    names.reserve(behaviors.size());
    for (const BehaviorId one : behaviors) names.push_back(behavior(one));
    return list_of(names);
  }
  [[nodiscard]] std::vector<std::string> conditions(
      const std::vector<StateCondition>& conditions) const {
    std::vector<std::string> texts;
    texts.reserve(conditions.size());
    for (const StateCondition& part : conditions) texts.push_back(condition(part));
    return texts;
  }
  [[nodiscard]] std::string situation(const StateCondition& part) const {
    if (part.kind == Kind::own)
      return behavior(part.behavior) + (part.wanted ? ": true" : ": false");
    std::vector<std::string> values;
    for (const std::uint32_t value : part.values) {
      values.push_back(in_quotes(catalog_.name_of_value({part.variable, value})));
    }
    return in_quotes(catalog_.name_of_variable(part.variable)) + ": " +
           (values.size() == 1 ? values.front() : list_of(values));
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
