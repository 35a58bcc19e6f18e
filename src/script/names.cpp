#include "script/names.h"

#include <string>
#include <utility>
#include <vector>

#include "cbc/rules.h"
#include "text/quote.h"
#include "yaml/values.h"

namespace cbc {
namespace {

// Of a name that is unknown as a `kind`, but perhaps known as another.
std::string describe_unknown(std::string_view name, std::string_view kind, bool is_other,
                             std::string_view other, Suggestions& suggestions) {
  std::string message = "there is no " + std::string(kind) + " " + quote(name);
  if (is_other) message += ": it is a " + std::string(other);
  if (const auto suggestion = suggestions.nearest(name)) {
    message += "; did you mean " + quote(*suggestion) + "?";
  }
  return message;
}

}  // namespace

NameIndex::Names::Names(const std::vector<std::string_view>& names) : suggestions(names) {
  places.reserve(names.size());
  for (const std::string_view name : names) {
    places.try_emplace(name, static_cast<std::uint32_t>(places.size()));
  }
}

NameIndex::NameIndex(const ScriptNames& names)
    : all_(names), tasks_(names.tasks), behaviors_(names.behaviors) {}

std::optional<std::uint32_t> NameIndex::find_task(const yaml::Node& node, std::string_view what,
                                                  Reporter& reporter) {
  const auto name = yaml::read_name(node, what, "the name of a task", reporter);
  if (!name) return std::nullopt;
  const auto found = tasks_.places.find(*name);
  if (found != tasks_.places.end()) return found->second;
  reporter.report(rule::undefined_task, node.range,
                  describe_unknown(*name, "task", behaviors_.places.contains(*name), "behavior",
                                   tasks_.suggestions));
  return std::nullopt;
}

std::optional<std::uint32_t> NameIndex::find_behavior(const yaml::Node& node, std::string_view what,
                                                      Reporter& reporter) {
  const auto name = yaml::read_name(node, what, "the name of a behavior", reporter);
  if (!name) return std::nullopt;
  const auto found = behaviors_.places.find(*name);
  if (found != behaviors_.places.end()) return found->second;
  reporter.report(rule::undefined_behavior, node.range,
                  describe_unknown(*name, "behavior", tasks_.places.contains(*name), "task",
                                   behaviors_.suggestions));
  return std::nullopt;
}

}  // namespace cbc
