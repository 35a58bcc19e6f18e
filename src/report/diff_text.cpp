#include "report/diff_text.h"

#include <string_view>

#include <fmt/format.h>

#include "text/decimal.h"
#include "text/quote.h"

namespace cbc {
namespace {

using Kind = CatalogChange::Kind;
using Subject = CatalogChange::Subject;

std::string describe(const AttributeValue& value) {
  if (const bool* const truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const Millionths* const degree = std::get_if<Millionths>(&value)) {
    return format_decimal(*degree, 4) + " %";
  }
  if (const Microseconds* const time = std::get_if<Microseconds>(&value)) {
    return format_decimal(*time, 6) + " s";
  }
  if (const std::string* const text = std::get_if<std::string>(&value)) {
    return text->empty() ? "any" : printable(*text);
  }
  return "none";
}

std::string describe_subject(const CatalogChange& change) {
  const std::string task = printable(change.task);
  const std::string behavior = printable(change.behavior);
  switch (change.subject) {
    case Subject::task:
      return "task " + task;
    case Subject::behavior:
      return "behavior " + behavior;
    case Subject::performs:
      return behavior + " performs " + task;
    case Subject::requirement:
      return behavior + " requires " + task;
    case Subject::exclusion:
      return task + " excludes " + printable(change.other_task);
  }
  return {};
}

std::string describe_attribute(const CatalogChange& change, const AttributeChange& attribute) {
  const std::string name = printable(attribute.name);
  if (change.kind == Kind::changed) {
    return fmt::format("{} {} -> {}", name, describe(attribute.before), describe(attribute.after));
  }
  return fmt::format("{} {}", name,
                     describe(change.kind == Kind::added ? attribute.after : attribute.before));
}

}  // namespace

std::string diff_text(const CatalogDiff& diff, const Style& style) {
  std::string text;
  for (const CatalogChange& change : diff.changes) {
    std::string_view color = style.warning;
    char sign = '~';
    if (change.kind == Kind::removed) {
      color = style.bad;
      sign = '-';
    } else if (change.kind == Kind::added) {
      color = style.good;
      sign = '+';
    }
    std::string line = fmt::format("{} {}", sign, describe_subject(change));
    std::string_view separator = ": ";
    // Of a new task the name is news enough; what it is set to stands in the catalog.
    const bool is_whole = change.kind != Kind::changed &&
                          (change.subject == Subject::task || change.subject == Subject::behavior);
    for (const AttributeChange& attribute : change.attributes) {
      if (is_whole) break;
      line += separator;
      line += describe_attribute(change, attribute);
      separator = ", ";
    }
    text += style.paint(color, line) + "\n";
  }
  if (diff.further_exclusions > 0) {
    text += fmt::format("and {} further exclusions\n", diff.further_exclusions);
  }
  return text;
}

}  // namespace cbc
