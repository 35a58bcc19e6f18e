#pragma once

#include <span>
#include <string_view>

#include "core/diagnostic/diagnostic.h"

/// The rules of lint: the kinds of findings there are, with all that is to be said about each.
namespace cbc {

/// A kind of mistake.
struct Rule {
  std::string_view name = {};
  Severity severity = Severity::error;  ///< unless the settings say otherwise
  /// A file that breaks the rule has no meaning, so the severity cannot be lowered.
  bool is_fixed = false;
  /// It takes a search, or all other rules, so that only lint checks it always; compile and solve
  /// do only if settings let it fail.
  bool needs_search = false;
  bool is_of_scripts = false;  ///< the examples are event scripts, for the catalog below
  // The texts are those of a file in the folder rules. They are ASCII; a paragraph is one line.
  std::string_view summary = {};      ///< one sentence: what is wrong
  std::string_view explanation = {};  ///< why it matters: paragraphs, separated by empty lines
  std::string_view settings = {};     ///< the settings file of the examples, if they need one
  std::string_view example = {};      ///< a whole file that breaks this rule, and no other
  std::string_view mending = {};      ///< what to do about it: a paragraph
  std::string_view mended = {};       ///< the example as it should be

  /// Findings name their rule.
  constexpr operator std::string_view() const { return name; }
};

/// All rules, in the order of their names.
[[nodiscard]] std::span<const Rule> all_rules();

/// The rule of a name, or nullptr.
[[nodiscard]] const Rule* find_rule(std::string_view name);

/// The catalog that the examples of rules about scripts run on.
[[nodiscard]] std::string_view example_catalog();

}  // namespace cbc

// rule::dead_task and so on, one for each file in the folder rules.
#include "rule_names.h"
