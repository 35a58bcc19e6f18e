#include "script/names.h"

#include <string>
#include <utility>
#include <vector>

#include "cbc/rules.h"
#include "text/quote.h"
#include "yaml/values.h"

namespace cbc {
namespace {

Suggestions& suggestions_from(const Texts& names, std::optional<Suggestions>& made) {
  if (!made) {
    std::vector<std::string_view> all;
    all.reserve(names.size());
    // NOLINTNEXTLINE(modernize-loop-convert): these texts have no iterators
    for (std::size_t place = 0; place < names.size(); ++place) all.push_back(names[place]);
    made.emplace(std::move(all));
  }
  return *made;
}

// Of a name that is unknown as a `kind`, but perhaps known as another.
std::string describe_unknown(std::string_view name, std::string_view kind, bool is_other,
                             std::string_view other, Suggestions& suggestions) {
  std::string message = "there is no " + std::string(kind) + " " + quote(name);
  if (is_other) message += ": it is a " + std::string(other);
  message += did_you_mean(suggestions.nearest(name));
  return message;
}

}  // namespace

std::optional<std::uint32_t> NameIndex::find_task(const yaml::Node& node, std::string_view what,
                                                  Reporter& reporter) {
  const auto name = yaml::read_name(node, what, "the name of a task", reporter);
  if (!name) return std::nullopt;
  const auto found = catalog_.find_task(*name);
  if (!found) {
    reporter.report(rule::undefined_task, node.range,
                    describe_unknown(*name, "task", catalog_.find_behavior(*name).has_value(),
                                     "behavior", suggestions_from(catalog_.task_names, tasks_)));
  }
  return found;
}

std::optional<std::uint32_t> NameIndex::find_behavior(const yaml::Node& node, std::string_view what,
                                                      Reporter& reporter) {
  const auto name = yaml::read_name(node, what, "the name of a behavior", reporter);
  if (!name) return std::nullopt;
  const auto found = catalog_.find_behavior(*name);
  if (!found) {
    reporter.report(
        rule::undefined_behavior, node.range,
        describe_unknown(*name, "behavior", catalog_.find_task(*name).has_value(), "task",
                         suggestions_from(catalog_.behavior_names, behaviors_)));
  }
  return found;
}

}  // namespace cbc
