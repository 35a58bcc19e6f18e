#include "core/catalog/no_catalog.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/catalog/foreign_file.h"
#include "core/catalog/older_format.h"
#include "core/catalog/shape.h"
#include "core/diagnostic/rules.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::Kind;
using yaml::Node;

void report_older_format(const OlderFormat& format, const yaml::Document& document,
                         Reporter& reporter) {
  const Conversion conversion = convert_older_format(document, {});
  std::string message = "this is a catalog of an older format, " + std::string(format.features) +
                        "; it is not supported";
  std::vector<Note> notes;
  if (conversion.obstacle) {
    message += ", and 'cbc lint --fix' cannot convert it";
    notes.push_back(reporter.note(conversion.obstacle->range, conversion.obstacle->message));
  } else if (conversion.leftovers.empty()) {
    message += "; 'cbc lint --fix' converts it";
  } else {
    message += "; 'cbc lint --fix' converts it, but for what the notes say";
  }
  for (const Leftover& leftover : conversion.leftovers) {
    notes.push_back(reporter.note(leftover.range, leftover.message));
  }
  reporter.report(rule::older_format, format.key->range, std::move(message), std::move(notes));
}

void report_inner_section(const InnerSection& inner, Reporter& reporter) {
  std::string message = quote(inner.key->text) + " must be a key of the file itself, found it in ";
  message += inner.outer == nullptr ? "a list" : quote(inner.outer->text);
  reporter.report(rule::missing_key, inner.key->range, std::move(message));
}

}  // namespace

bool report_no_catalog(const yaml::Document& document, Reporter& reporter) {
  const Node& root = document.root();
  if (root.kind == Kind::null) {
    reporter.report(rule::missing_key, root.range, "missing key 'behaviors': the catalog is empty");
  } else if (const auto format = find_older_format(root)) {
    report_older_format(*format, document, reporter);
  } else if (resembles_catalog(root)) {
    return false;
  } else if (const auto inner = find_inner_section(root)) {
    report_inner_section(*inner, reporter);
  } else if (const std::string_view found = find_foreign_file(root); !found.empty()) {
    reporter.report(rule::wrong_type, root.range, describe_foreign_file("behavior catalog", found));
  } else if (root.kind != Kind::mapping) {
    reporter.report(
        rule::wrong_type, root.range,
        "a catalog must be a mapping with the key 'behaviors', found " + yaml::describe(root));
  } else {
    return false;  // perhaps one without the key that all have
  }
  return true;
}

}  // namespace cbc
