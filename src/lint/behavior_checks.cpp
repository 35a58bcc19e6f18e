#include "lint/behavior_checks.h"

#include <algorithm>

#include "cbc/rules.h"
#include "lint/percent.h"
#include "text/decimal.h"
#include "text/quote.h"

namespace cbc {
namespace {

void check_suitability(const Performance& performance, Reporter& reporter) {
  if (!performance.suitability_range) return;
  const Millionths suitability = performance.suitability;
  // One number may be that of many behaviors, so the message names none.
  if (suitability == 0) {
    reporter.report(rule::suspicious_suitability, *performance.suitability_range,
                    "a suitability of 0 % makes the performance of all that depends on it 0");
  } else if (looks_like_fraction(suitability)) {
    reporter.report(rule::suspicious_suitability, *performance.suitability_range,
                    "a suitability of " + format_percent(suitability) + " is next to nothing; is " +
                        format_percent(std::int64_t{suitability} * 100) + " meant?");
  }
}

void check_timeout(const Catalog& catalog, const Behavior& behavior, Reporter& reporter) {
  if (!behavior.timeout || behavior.performs.empty()) return;
  const bool has_effect = std::any_of(behavior.performs.begin(), behavior.performs.end(),
                                      [&catalog](const Performance& performance) {
                                        return catalog.tasks[performance.task].execution_goal ==
                                               ExecutionGoal::achieve_goal;
                                      });
  if (has_effect) return;
  reporter.report(rule::no_timeout_effect, behavior.timeout_range,
                  "the timeout of behavior " + quote(behavior.name) +
                      " has no effect: the execution_goal of what it performs is keep_running");
}

}  // namespace

void check_behaviors(const Catalog& catalog, bool is_complete, Reporter& reporter) {
  for (const Behavior& behavior : catalog.behaviors) {
    for (const Performance& performance : behavior.performs) {
      check_suitability(performance, reporter);
    }
    for (const Requirement& requirement : behavior.requirements) {
      check_suspicious_minimum(requirement.minimum_performance,
                               requirement.minimum_performance_range, reporter);
    }
    if (is_complete) check_timeout(catalog, behavior, reporter);
  }
}

}  // namespace cbc
