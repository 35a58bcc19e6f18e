#include "cli/value_kind.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "text/nearest.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

// A validator is what CLI11 lets one attach to an option. Its name says what it is.
constexpr const char* choice_name = "choice";
constexpr std::array<std::pair<ValueKind, const char*>, 9> kind_names = {
    {{ValueKind::catalog, "a catalog"},
     {ValueKind::script, "a script"},
     {ValueKind::catalog_or_script, "a catalog or a script"},
     {ValueKind::shard, "the result of a shard"},
     {ValueKind::file, "a file"},
     {ValueKind::rule, "a rule"},
     {ValueKind::schema, "a schema"},
     {ValueKind::task, "a task"},
     {ValueKind::task_or_behavior, "a task or a behavior"}}};

const CLI::Validator* find_validator(CLI::Option& option, const std::string& name) {
  try {
    return option.get_validator(name);
  } catch (const CLI::OptionNotFound&) {
    return nullptr;
  }
}

}  // namespace

std::string describe(ValueKind kind) {
  const auto* const named = std::find_if(kind_names.begin(), kind_names.end(),
                                         [&](const auto& known) { return known.first == kind; });
  return named->second;
}

CLI::Validator stands_for(ValueKind kind) {
  return {[](const std::string&) { return std::string(); }, "", describe(kind)};
}

std::optional<ValueKind> kind_of(CLI::Option& option) {
  for (const auto& [kind, name] : kind_names) {
    if (find_validator(option, name) != nullptr) return kind;
  }
  return std::nullopt;
}

CLI::Validator one_of(const std::vector<std::string>& choices) {
  const auto check = [choices](const std::string& text) -> std::string {
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return {};
    const std::vector<std::string_view> names(choices.begin(), choices.end());
    return fmt::format("expected {}, found {}{}", list_choices(choices), quote(text),
                       did_you_mean(nearest(text, names)));
  };
  return {check, fmt::format("{}", fmt::join(choices, ",")), choice_name};
}

std::vector<std::string> choices_of(CLI::Option& option) {
  const CLI::Validator* const choice = find_validator(option, choice_name);
  if (choice == nullptr) return {};
  return CLI::detail::split(choice->get_description(), ',');
}

std::string list_choices(const std::vector<std::string>& choices) {
  std::string list = choices.front();
  for (std::size_t i = 1; i < choices.size(); ++i) {
    list += (i + 1 < choices.size() ? ", " : " or ") + choices[i];
  }
  return list;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_min() > 0; }

}  // namespace cbc::cli
