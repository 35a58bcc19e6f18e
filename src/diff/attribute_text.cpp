#include "diff/attribute_text.h"

#include <fmt/format.h>

#include "text/decimal.h"
#include "text/quote.h"

namespace cbc {
namespace {

std::string describe_value(const AttributeValue& value) {
  if (const bool* const truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const Millionths* const degree = std::get_if<Millionths>(&value)) {
    return format_percent(*degree);
  }
  if (const Microseconds* const time = std::get_if<Microseconds>(&value)) {
    return format_decimal(*time, 6) + " s";
  }
  if (const std::string* const text = std::get_if<std::string>(&value)) {
    return text->empty() ? "any" : printable(*text);
  }
  return "none";
}

}  // namespace

std::string describe(const CatalogChange& change, const AttributeChange& attribute) {
  const std::string name = printable(attribute.name);
  const std::string before = describe_value(attribute.before);
  const std::string after = describe_value(attribute.after);
  switch (change.kind) {
    case CatalogChange::Kind::removed:
      return fmt::format("{} {}", name, before);
    case CatalogChange::Kind::added:
      return fmt::format("{} {}", name, after);
    case CatalogChange::Kind::changed:
      break;
  }
  return fmt::format("{} {} -> {}", name, before, after);
}

}  // namespace cbc
