#include "lsp/language/hover.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "core/catalog/allowed_values.h"
#include "core/catalog/situation.h"
#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "lsp/language/places.h"
#include "lsp/language/schema.h"
#include "runtime/base/text.h"

namespace cbc::lsp {
namespace {

using Texts = std::vector<std::string>;

/// More things than these are counted.
constexpr std::size_t most_listed = 20;

/// For the inside of a line. An underscore within a word has no meaning, and is not shown well with
/// a backslash where an editor shows the text as it is.
std::string escaped(std::string_view text) {
  constexpr std::string_view special = "\\`*[]<>|~&";
  const std::string shown = printable(text);
  const auto is_of_word = [&shown](std::size_t place) {
    return place < shown.size() &&
           (std::isalnum(static_cast<unsigned char>(shown[place])) != 0 || shown[place] == '_');
  };
  std::string result;
  for (std::size_t place = 0; place < shown.size(); ++place) {
    const bool is_edge = shown[place] == '_' && !(is_of_word(place - 1) && is_of_word(place + 1));
    if (is_edge || special.find(shown[place]) != std::string_view::npos) result += '\\';
    result += shown[place];
  }
  return result;
}

std::string list(const Texts& texts) {
  const std::size_t listed = std::min(texts.size(), most_listed);
  std::string text = join(Texts(texts.begin(), texts.begin() + static_cast<std::ptrdiff_t>(listed)),
                          ", ", escaped);
  if (listed < texts.size()) text += fmt::format(" and {} more", texts.size() - listed);
  return text;
}

/// An item of a Markdown list; nothing without texts.
std::string line(std::string_view what, const Texts& texts) {
  return texts.empty() ? "" : fmt::format("- {}: {}\n", what, list(texts));
}

std::string heading(std::string_view kind, std::string_view name) {
  return fmt::format("{} **{}**\n\n", kind, escaped(name));
}

std::string with_minimum(std::string name, Millionths minimum) {
  return minimum == 0 ? name : fmt::format("{} (at least {})", name, format_percent(minimum));
}

std::string describe_task(const Catalog& catalog, const Task& task) {
  const auto index = static_cast<TaskIndex>(&task - catalog.tasks.data());
  Texts performed_by;
  Texts required_by;
  for (const Behavior& behavior : catalog.behaviors) {
    for (const Performance& performance : behavior.performs) {
      if (performance.task != index) continue;
      performed_by.push_back(
          fmt::format("{} ({})", behavior.name, format_percent(performance.suitability)));
    }
    for (const Requirement& requirement : behavior.requirements) {
      if (requirement.task != index) continue;
      required_by.push_back(with_minimum(behavior.name, requirement.minimum_performance));
    }
  }
  std::set<TaskIndex> excluded;
  std::string limits;
  for (const ExclusivityList& exclusivity : catalog.exclusivity) {
    const std::vector<TaskIndex> tasks = distinct_tasks(exclusivity);
    if (!std::binary_search(tasks.begin(), tasks.end(), index)) continue;
    if (exclusivity.at_most > 1) {
      Texts members;
      for (const TaskIndex member : tasks) members.push_back(catalog.tasks[member].name);
      limits += line(fmt::format("at most {} of", exclusivity.at_most), members);
      continue;
    }
    excluded.insert(tasks.begin(), tasks.end());
  }
  excluded.erase(index);
  Texts excludes;
  for (const TaskIndex other : excluded) excludes.push_back(catalog.tasks[other].name);
  std::string text = heading("task", task.name);
  text += performed_by.empty() ? "- no behavior performs it\n" : line("performed by", performed_by);
  text += line("excludes", excludes) + limits;
  text += line("required by", required_by);
  const TaskRules& rules = task.rules;
  if (rules.reactive_priority > 0) {
    text += fmt::format("- starts by itself, with priority {}\n", rules.reactive_priority);
  } else if (task.reactive_start) {
    text += "- starts by itself whenever nothing prevents it\n";
  }
  if (rules.requestable == 0) text += "- nobody may request it\n";
  if (rules.resume != 0) text += "- its request is suspended if something else stops it\n";
  if (rules.improve == Improve::at_once) {
    text += "- gets a more suitable behavior as soon as one is possible\n";
  } else if (rules.improve == Improve::when_started) {
    text += "- gets a more suitable behavior only when it is started\n";
  }
  if (!task.start_on_request) text += "- also starts when a behavior requires it\n";
  if (task.execution_goal == ExecutionGoal::keep_running) text += "- keeps running\n";
  if (task.timeout) text += line("timeout", {format_decimal(*task.timeout, 6) + " s"});
  if (task.minimum_performance != 0) {
    text += line("minimum performance", {format_percent(task.minimum_performance)});
  }
  Texts parameters;
  for (const Parameter& parameter : task.parameters) {
    parameters.push_back(concat(parameter.name, " ", describe_allowed(parameter)));
  }
  return text + line("parameters", parameters);
}

std::string describe_behavior(const Catalog& catalog, const Behavior& behavior) {
  Texts performs;
  for (const Performance& performance : behavior.performs) {
    performs.push_back(fmt::format("{} ({})", catalog.tasks[performance.task].name,
                                   format_percent(performance.suitability)));
  }
  Texts requirements;
  for (const Requirement& requirement : behavior.requirements) {
    requirements.push_back(
        with_minimum(catalog.tasks[requirement.task].name, requirement.minimum_performance));
  }
  Texts situation;
  for (const NamedCondition& condition : conditions_of(catalog, behavior)) {
    situation.push_back(cbc::describe(condition));
  }
  std::string text = heading("behavior", behavior.name);
  text += line("performs", performs) + line("requires", requirements) + line("fits in", situation);
  if (behavior.retry == Retry::after_repair) {
    text += "- after a failure, tried again after its repair\n";
  } else if (behavior.retry == Retry::when_started) {
    text += "- after a failure, tried again after its repair, or when somebody starts its task\n";
  }
  if (behavior.timeout) text += line("timeout", {format_decimal(*behavior.timeout, 6) + " s"});
  if (!behavior.package.empty()) text += line("package", {behavior.package});
  return text;
}

std::string describe_variable(const Catalog& catalog, const Variable& variable) {
  Texts dependent;
  for (const Behavior& behavior : catalog.behaviors) {
    for (const NamedCondition& condition : conditions_of(catalog, behavior)) {
      if (condition.variable != variable.name) continue;
      dependent.push_back(fmt::format("{} ({})", behavior.name, cbc::describe(condition)));
    }
  }
  return heading("situation variable", variable.name) + line("values", variable.values) +
         line("at first", {variable.values.front()}) +
         line("behaviors that depend on it", dependent);
}

std::string describe_name(NameKind kind, const std::string& name, const Catalog& catalog) {
  if (const Task* const task = kind == NameKind::task ? find_task(&catalog, name) : nullptr) {
    return describe_task(catalog, *task);
  }
  if (kind == NameKind::behavior && find_behavior(&catalog, name) != nullptr) {
    return describe_behavior(catalog, *find_behavior(&catalog, name));
  }
  if (kind == NameKind::variable && find_variable(&catalog, name) != nullptr) {
    return describe_variable(catalog, *find_variable(&catalog, name));
  }
  return fmt::format("the catalog has no {} {}\n", name_of(kind), escaped(name));
}

/// The description of a key in the schema.
std::string describe_key(const std::string& key, const SchemaPlace& place) {
  const std::string text = place.description();
  return text.empty() ? "" : heading("key", key) + escaped(text) + "\n";
}

}  // namespace

std::string describe(const Context& context, cli::FileKind kind, const Catalog* catalog) {
  if (context.text.empty()) return {};
  if (const auto name = name_kind_at(context, kind, catalog)) {
    return catalog == nullptr ? "" : describe_name(*name, context.text, *catalog);
  }
  const SchemaPlace place(kind, context.path);
  if (context.is_key) return describe_key(context.text, place.at(context.text));
  if (kind == cli::FileKind::settings && context.is_item) return describe_rule(context.text);
  const auto owner = owner_at(context);
  if (!owner) return {};
  const auto names = names_of_keys(owner->path, kind);
  const Variable* const variable = find_variable(catalog, owner->key);
  if ((names == Names::variable || names == Names::part) && variable != nullptr) {
    return describe_variable(*catalog, *variable);
  }
  // A word or a number is explained with its key.
  return describe_key(owner->key, SchemaPlace(kind, owner->path).at(owner->key));
}

std::string describe_rule(std::string_view name) {
  const Rule* const rule = find_rule(name);
  if (rule == nullptr) return {};
  const auto code = [](std::string_view text) { return fmt::format("```yaml\n{}```\n", text); };
  return fmt::format("{} **{}**: {}\n\n{}\n\n{}\n{}\n\n{}", name_of(rule->severity), name,
                     escaped(rule->summary), escaped(rule->explanation), code(rule->example),
                     escaped(rule->mending), code(rule->mended));
}

}  // namespace cbc::lsp
