#include "lint/conflicting_requirements.h"

#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>

#include "cbc/rules.h"
#include "text/quote.h"

namespace cbc {
namespace {

class ConflictCheck {
 public:
  explicit ConflictCheck(Semantics& semantics) : semantics_(semantics) {
    const Catalog& catalog = semantics.catalog();
    lists_of_.resize(catalog.tasks.size());
    for (std::size_t list = 0; list < catalog.exclusivity.size(); ++list) {
      for (const TaskIndex task : catalog.exclusivity[list].tasks) lists_of_[task].push_back(list);
    }
  }

  /// Reports each requirement that conflicts with one before it, once.
  void check(BehaviorId id) {
    const Behavior& behavior = semantics_.behavior(id);
    std::unordered_map<std::size_t, const Requirement*> first_in;  // by list
    for (const Requirement& requirement : behavior.requirements) {
      if (semantics_.exclusions().find_for_all(behavior, requirement.task)) {
        semantics_.explain_behavior(id);
        continue;
      }
      bool is_reported = false;
      for (const std::size_t list : lists_of_[requirement.task]) {
        const Requirement*& first = first_in.try_emplace(list, &requirement).first->second;
        if (first->task == requirement.task || is_reported) continue;
        report(behavior, requirement, *first, list);
        is_reported = true;
        semantics_.explain_behavior(id);
      }
    }
  }

 private:
  void report(const Behavior& behavior, const Requirement& requirement, const Requirement& other,
              std::size_t list) {
    const Catalog& catalog = semantics_.catalog();
    Reporter& reporter = semantics_.reporter();
    const std::string name = quote(catalog.tasks[requirement.task].name);
    const std::string other_name = quote(catalog.tasks[other.task].name);
    reporter.report(
        rule::conflicting_requirements, requirement.range,
        "behavior " + quote(behavior.name) + " requires both " + name + " and " + other_name +
            ", which exclude one another, so it can never be active",
        {reporter.note(other.range, other_name + " is required here"),
         reporter.note(catalog.exclusivity[list].range, "mutually exclusive by this list")});
  }

  Semantics& semantics_;
  std::vector<std::vector<std::size_t>> lists_of_;  ///< by task in catalog order
};

}  // namespace

void check_conflicting_requirements(Semantics& semantics) {
  ConflictCheck check(semantics);
  for (BehaviorId id = 0; id < semantics.compiled().behaviors.size(); ++id) check.check(id);
}

}  // namespace cbc
