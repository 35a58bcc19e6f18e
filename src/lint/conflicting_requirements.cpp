#include "lint/conflicting_requirements.h"

#include <cstddef>
#include <string>
#include <unordered_map>

#include "catalog/describe.h"
#include "catalog/exclusions.h"
#include "cbc/rules.h"
#include "text/quote.h"

namespace cbc {
namespace {

class ConflictCheck {
 public:
  ConflictCheck(const Catalog& catalog, Reporter& reporter)
      : catalog_(catalog), reporter_(reporter), exclusions_(catalog) {}

  /// Reports each requirement that conflicts with one before it, once. Whether there is one.
  bool check(const Behavior& behavior) {
    bool has_conflict = false;
    std::unordered_map<std::size_t, const Requirement*> first_in;  // by list
    for (const Requirement& requirement : behavior.requirements) {
      if (exclusions_.find_for_all(behavior, requirement.task)) {
        has_conflict = true;
        continue;
      }
      bool is_reported = false;
      for (const std::size_t list : exclusions_.lists_of(requirement.task)) {
        const Requirement*& first = first_in.try_emplace(list, &requirement).first->second;
        if (first->task == requirement.task || is_reported) continue;
        report(behavior, requirement, *first, list);
        is_reported = true;
      }
      has_conflict |= is_reported;
    }
    return has_conflict;
  }

 private:
  void report(const Behavior& behavior, const Requirement& requirement, const Requirement& other,
              std::size_t list) {
    const std::string name = quote(catalog_.tasks[requirement.task].name);
    const std::string other_name = quote(catalog_.tasks[other.task].name);
    reporter_.report(
        rule::conflicting_requirements, requirement.range,
        describe(behavior) + " requires both " + other_name + " and " + name +
            ", which exclude one another, so it can never be active",
        {reporter_.note(other.range, other_name + " is required here"),
         reporter_.note(catalog_.exclusivity[list].range, "mutually exclusive by this list")});
  }

  const Catalog& catalog_;
  Reporter& reporter_;
  Exclusions exclusions_;
};

}  // namespace

std::vector<bool> check_conflicting_requirements(const Catalog& catalog, Reporter& reporter) {
  ConflictCheck check(catalog, reporter);
  std::vector<bool> conflicts;
  for (const Behavior& behavior : catalog.behaviors) conflicts.push_back(check.check(behavior));
  return conflicts;
}

}  // namespace cbc
