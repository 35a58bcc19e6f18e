#include "report/diff_text.h"

#include <string_view>

#include <fmt/format.h>

#include "diff/attribute_text.h"
#include "text/quote.h"

namespace cbc {
namespace {

using ChangeKind = CatalogChange::Kind;
using ChangeSubject = CatalogChange::Subject;

std::string describe_subject(const CatalogChange& change) {
  const std::string task = printable(change.task);
  const std::string behavior = printable(change.behavior);
  switch (change.subject) {
    case ChangeSubject::task:
      return "task " + task;
    case ChangeSubject::behavior:
      return "behavior " + behavior;
    case ChangeSubject::performs:
      return behavior + " performs " + task;
    case ChangeSubject::requirement:
      return behavior + " requires " + task;
    case ChangeSubject::exclusion:
      return task + " excludes " + printable(change.other_task);
  }
  return {};
}

}  // namespace

std::string diff_text(const CatalogDiff& diff, const Style& style) {
  std::string text;
  for (const CatalogChange& change : diff.changes) {
    std::string_view color = style.warning;
    char sign = '~';
    if (change.kind == ChangeKind::removed) {
      color = style.bad;
      sign = '-';
    } else if (change.kind == ChangeKind::added) {
      color = style.good;
      sign = '+';
    }
    std::string line = fmt::format("{} {}", sign, describe_subject(change));
    std::string_view separator = ": ";
    // Of a new task the name is news enough; what it is set to stands in the catalog.
    const bool is_whole =
        change.kind != ChangeKind::changed &&
        (change.subject == ChangeSubject::task || change.subject == ChangeSubject::behavior);
    for (const AttributeChange& attribute : change.attributes) {
      if (is_whole) break;
      line += separator;
      line += describe(change, attribute);
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
