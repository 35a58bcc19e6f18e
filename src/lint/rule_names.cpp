#include "lint/rule_names.h"

#include <optional>
#include <vector>

#include "text/quote.h"

namespace cbc {
namespace {

std::vector<std::string_view> names_of_rules() {
  std::vector<std::string_view> names;
  for (const Rule& rule : all_rules()) names.push_back(rule.name);
  return names;
}

}  // namespace

RuleNames::RuleNames() : suggestions_(names_of_rules()) {}

std::string RuleNames::describe_unknown(std::string_view name) {
  std::string message = "there is no rule " + quote(name);
  message += did_you_mean(suggestions_.nearest(name));
  return message;
}

std::string describe_fixed(const Rule& rule) {
  return quote(rule.name) + " is always an error: a file that breaks this rule has no meaning";
}

}  // namespace cbc
