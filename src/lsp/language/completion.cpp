#include "lsp/language/completion.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/catalog/allowed_values.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "core/yaml/source.h"
#include "core/yaml/values.h"
#include "lsp/language/places.h"
#include "lsp/language/schema.h"
#include "runtime/base/text.h"

namespace cbc::lsp {
namespace {

using cli::FileKind;
using Kind = Completion::Kind;

/// A whole entry of a list. It is on one line, as clients indent further lines in different ways.
struct Snippet {
  FileKind kind;
  std::string_view list;  ///< the steps to the list; "-" is an item
  std::string_view label;
  std::string_view text;  ///< JSON; without its quotes it is YAML
};

constexpr Snippet snippets[] = {
    {FileKind::catalog, "behaviors", "behavior",
     R"({"behavior": "${1:NAME}", "task": "${2:TASK}", "suitability": ${3:100}})"},
    {FileKind::catalog, "behaviors", "behavior that requires a task",
     R"({"behavior": "${1:NAME}", "task": "${2:TASK}", "suitability": ${3:100}, )"
     R"("requires": [{"task": "${4:OTHER}"}]})"},
    {FileKind::catalog, "behaviors/-/tasks", "task performed",
     R"({"task": "${1:TASK}", "suitability": ${2:100}})"},
    {FileKind::catalog, "behaviors/-/requires", "requirement", R"({"task": "${1:TASK}"})"},
    {FileKind::catalog, "behaviors/-/requires", "requirement with a minimum performance",
     R"({"task": "${1:TASK}", "minimum_performance": ${2:80}})"},
    {FileKind::catalog, "tasks", "task", R"({"task": "${1:NAME}"})"},
    {FileKind::catalog, "tasks", "supporting task",
     R"({"task": "${1:NAME}", "start_on_request": false, "execution_goal": "keep_running"})"},
    {FileKind::catalog, "tasks/-/parameters", "parameter",
     R"({"parameter": "${1:NAME}", "allowed_values": [${2:0}, ${3:100}]})"},
    {FileKind::catalog, "exclusivity_constraints", "tasks that exclude one another",
     R"({"mutually_exclusive": ["${1:TASK}", "${2:OTHER}"]})"},
    {FileKind::catalog, "exclusivity_constraints", "tasks of which some may run",
     R"({"mutually_exclusive": ["${1:TASK}", "${2:OTHER}", "${3:THIRD}"], "at_most": ${4:2}})"},
    {FileKind::catalog, "situation", "variable", R"({"variable": "${1:NAME}"})"},
    {FileKind::catalog, "situation", "variable with values",
     R"({"variable": "${1:NAME}", "values": ["${2:VALUE}", "${3:OTHER}"]})"},
    {FileKind::script, "events", "start", R"({"start": "${1:TASK}"})"},
    {FileKind::script, "events", "start with a priority",
     R"({"start": "${1:TASK}", "priority": ${2:2}})"},
    {FileKind::script, "events", "stop", R"({"stop": "${1:TASK}"})"},
    {FileKind::script, "events", "finish",
     R"({"finish": "${1:BEHAVIOR}", "cause": "${2:goal_achieved}"})"},
    {FileKind::script, "events", "finish of a task", R"({"finish": {"task": "${1:TASK}"}})"},
    {FileKind::script, "events", "situation", R"({"situation": {"${1:NAME}": ${2:false}}})"},
    {FileKind::script, "events", "fault", R"({"fault": "${1:BEHAVIOR}"})"},
    {FileKind::script, "events", "repair", R"({"repair": "${1:BEHAVIOR}"})"},
    {FileKind::script, "events", "wait", R"({"wait": ${1:10}})"},
    {FileKind::script, "events", "expect", R"({"expect": {"running": {"${1:TASK}": "${2:any}"}}})"},
    {FileKind::script, "events", "expect an outcome",
     R"({"expect": {"outcome": "${1:accepted}", "running": {"${2:TASK}": "${3:any}"}}})"},
    {FileKind::properties, "properties", "can_start", R"({"can_start": "${1:TASK}"})"},
    {FileKind::properties, "properties", "always",
     R"({"always": {"running": ["${1:TASK}"]}, "when": {"running": ["${2:TASK}"]}})"},
    {FileKind::properties, "properties", "never",
     R"({"never": {"running": ["${1:TASK}", "${2:OTHER}"]}})"},
    {FileKind::properties, "properties", "reachable",
     R"({"reachable": {"running": ["${1:TASK}"]}})"},
    {FileKind::properties, "properties", "keeps_running",
     R"({"keeps_running": "${1:TASK}", "by": ["${2:start}"]})"},
    {FileKind::properties, "properties", "always_possible",
     R"({"always_possible": {"running": ["${1:TASK}"]}})"},
};

/// Whether a text without quotes is that text, and no number or boolean, also in brackets.
bool may_be_plain(const std::string& text) {
  const bool is_number = text.find_first_not_of("0123456789.+-_eE") == std::string::npos;
  if (is_number || printable(text) != text) return false;
  // Most names are words longer than the longest boolean, or with a digit: no need to parse them.
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  constexpr std::string_view digits = "0123456789_";
  const bool is_word = letters.find(text.front()) != std::string_view::npos &&
                       text.find_first_not_of(concat(letters, digits)) == std::string::npos;
  if (is_word && (text.size() > 5 || text.find_first_of(digits) != std::string::npos)) return true;
  Diagnostics ignored;
  const auto document = yaml::parse(concat("[", text, ", {", text, ": ", text, "}]"), {}, ignored);
  if (document == nullptr || document->root().items.size() != 2) return false;
  const yaml::Node& item = *document->root().items[0];
  const auto& entries = document->root().items[1]->entries;
  return item.plain && item.text == text && !yaml::to_boolean(item) && entries.size() == 1 &&
         entries[0].first->text == text && entries[0].second->text == text;
}

class Completer {
 public:
  Completer(const Context& context, FileKind kind, const Catalog* catalog)
      : context_(context), kind_(kind), catalog_(catalog), place_(kind, context.path) {}

  std::vector<Completion> complete() && {
    if (context_.is_key) {
      add_keys(place_);
      add_parameters();
      if (const auto names = names_of_keys(context_.path, kind_)) add_names(*names);
      add_entries(context_.path, "- ");
      if (!context_.list_key.empty()) add_entries(path_to(context_.list_key), "- ");
    } else if (!context_.key.empty()) {
      add_values(place_.at(context_.key));
      if (context_.is_open) {
        add_keys(place_.at(context_.key));
        add_entries(path_to(context_.key), "- ");
      }
    } else if (context_.is_item) {
      add_values(place_.at(""));
      if (context_.is_open) add_keys(place_.at(""));
      add_entries(context_.path, "");
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::vector<std::string> path_to(const std::string& key) const {
    std::vector<std::string> path = context_.path;
    path.push_back(key);
    return path;
  }

  [[nodiscard]] std::string spell(const std::string& text) const {
    return context_.is_json || !may_be_plain(text) ? yaml::in_quotes(text) : text;
  }

  /// A key at the place of a key, or else a value. `word`: it may be a boolean or a number.
  void add(Kind kind, const std::string& label, std::string detail, std::string documentation = {},
           bool is_word = false) {
    const bool is_literal = is_word && (!context_.is_json || label == "true" || label == "false" ||
                                        parse_number(label));
    std::string insert = is_literal ? label : spell(label);
    const bool is_key = kind == Kind::key || context_.is_key;
    if (is_key && !context_.has_colon) insert += ": ";
    result_.push_back(
        {kind, label, std::move(detail), std::move(documentation), std::move(insert)});
  }

  [[nodiscard]] bool has_sibling(const std::string& key) const {
    return context_.is_key && std::find(context_.siblings.begin(), context_.siblings.end(), key) !=
                                  context_.siblings.end();
  }

  void add_keys(const SchemaPlace& place) {
    const std::vector<SchemaKey> keys = place.keys();
    const bool is_chosen = std::any_of(keys.begin(), keys.end(), [this](const SchemaKey& key) {
      return key.is_choice && has_sibling(key.name);
    });
    for (const SchemaKey& key : keys) {
      if (has_sibling(key.name) || (is_chosen && key.is_choice)) continue;
      add(Kind::key, key.name, key.is_required ? "required" : "", key.description);
    }
  }

  // Names -----------------------------------------------------------------------------------------

  void add_names(Names names) {
    if (catalog_ == nullptr) return;
    if (names == Names::task) {
      for (const Task& task : catalog_->tasks) add_name(Kind::task, task.name, "task");
    }
    if (names == Names::variable || names == Names::part) {
      for (const Variable& variable : catalog_->variables) {
        add_name(Kind::variable, variable.name, join(variable.values, ", "));
      }
    }
    if (names == Names::behavior || names == Names::part) {
      for (const Behavior& behavior : catalog_->behaviors) {
        add_name(Kind::behavior, behavior.name, performed_by(behavior));
      }
    }
  }

  void add_name(Kind kind, const std::string& name, std::string detail) {
    if (!name.empty() && !has_sibling(name)) add(kind, name, std::move(detail));
  }

  [[nodiscard]] std::string performed_by(const Behavior& behavior) const {
    return join(behavior.performs, ", ", [this](const Performance& performance) {
      return concat(catalog_->tasks[performance.task].name, " ",
                    format_percent(performance.suitability));
    });
  }

  /// The behaviors that perform a task.
  void add_performers(const std::string& task) {
    for (const Behavior& behavior : catalog_->behaviors) {
      const bool performs = std::any_of(
          behavior.performs.begin(), behavior.performs.end(),
          [&](const Performance& one) { return catalog_->tasks[one.task].name == task; });
      if (performs) add_name(Kind::behavior, behavior.name, performed_by(behavior));
    }
  }

  // Values ----------------------------------------------------------------------------------------

  void add_values(const SchemaPlace& place) {
    for (const std::string& word : place.words()) {
      add(Kind::value, word, "", place.description(), true);
    }
    const auto owner = owner_at(context_);
    if (owner) add_values_of(*owner);
    const auto names = names_at(context_, kind_);
    if (kind_ == FileKind::catalog && owner && context_.path.size() == 2 && names) {
      add_names_to_define(*names, owner->key);
    } else if (names && owner && names_of_keys(owner->path, kind_) == Names::task && catalog_) {
      add_performers(owner->key);
    } else if (names) {
      add_names(*names);
    }
    if (kind_ == FileKind::settings && owner && owner->path.empty() && context_.is_item) {
      for (const Rule& rule : all_rules()) {
        add(Kind::value, std::string(rule.name), std::string(name_of(rule.severity)),
            std::string(rule.summary));
      }
    }
  }

  /// The name of a new entry is new, except that of a task which behaviors name.
  void add_names_to_define(Names names, const std::string& key) {
    if (names != Names::task || catalog_ == nullptr) return;
    const bool is_entry = context_.path.front() == "tasks" && key == "task";
    for (const Task& task : catalog_->tasks) {
      if (!is_entry || task.implicit || task.name == context_.text) {
        add_name(Kind::task, task.name, "task");
      }
    }
  }

  void add_values_of(const Owner& owner) {
    const auto names = names_of_keys(owner.path, kind_);
    if (names == Names::variable || names == Names::part) {
      if (const Variable* const variable = find_variable(catalog_, owner.key)) {
        for (const std::string& value : variable->values) {
          add(Kind::value, value, "value of " + owner.key, "", variable->is_boolean);
        }
      } else if (find_behavior(catalog_, owner.key) != nullptr) {
        add(Kind::value, "true", "available", "", true);
        add(Kind::value, "false", "unavailable", "", true);
      }
    }
    const bool is_running = names == Names::task && owner.path.back() == "running";
    if (is_running && !context_.is_item) {
      add(Kind::value, "any", "any behavior of the task", "", true);
    }
    if (kind_ == FileKind::script && owner.key == "finish" && !context_.is_json) {
      result_.push_back({Kind::snippet, "task: TASK", "whatever performs the task", "",
                         "{task: ${1:TASK}}", true});
    }
    for (const Parameter& parameter : parameters_at(context_, owner.path, kind_, catalog_)) {
      if (parameter.name != owner.key || range_of(parameter)) continue;
      if (parameter.allowed_is_list) {
        for (const std::string& value : parameter.allowed_values)
          add(Kind::value, value, "", "", true);
      } else if (describe_allowed(parameter).starts_with("bool")) {
        add(Kind::value, "true", "", "", true);
        add(Kind::value, "false", "", "", true);
      }
    }
  }

  void add_parameters() {
    for (const Parameter& parameter : parameters_at(context_, context_.path, kind_, catalog_)) {
      if (!has_sibling(parameter.name)) add(Kind::key, parameter.name, describe_allowed(parameter));
    }
  }

  // Snippets --------------------------------------------------------------------------------------

  /// Entries of the list at a path. They need a dash on a line that has none.
  void add_entries(const std::vector<std::string>& path, std::string_view dash) {
    if (context_.has_colon || (context_.is_flow && !dash.empty())) return;
    const std::string list =
        join(path.empty() && kind_ == FileKind::script ? std::vector<std::string>{"events"}
                                                       : normal_path(path, kind_),
             "/", [](const std::string& step) { return step.empty() ? "-" : step; });
    for (const Snippet& snippet : snippets) {
      if (snippet.kind != kind_ || snippet.list != list) continue;
      std::string text(snippet.text);
      if (!context_.is_json) std::erase(text, '"');
      result_.push_back(
          {Kind::snippet, std::string(snippet.label), "snippet", "", concat(dash, text), true});
    }
  }

  const Context& context_;
  const FileKind kind_;
  const Catalog* const catalog_;
  const SchemaPlace place_;
  std::vector<Completion> result_;
};

}  // namespace

std::vector<Completion> complete(const Context& context, FileKind kind, const Catalog* catalog) {
  return Completer(context, kind, catalog).complete();
}

}  // namespace cbc::lsp
