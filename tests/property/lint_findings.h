// The findings of the semantic rules on a catalog that catalog_yaml() wrote, read back in terms of
// the model: the place says what a finding is about.
#pragma once

#include <compare>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "lint_oracle.h"
#include "model.h"

namespace cbc::oracle {

// A requirement as it is written, in the order of the file.
struct RequirementEntry {
  std::size_t behavior = 0;
  std::size_t place = 0;

  auto operator<=>(const RequirementEntry&) const = default;
};

struct Findings {
  std::vector<RequirementEntry> exclusive;
  std::map<RequirementEntry, RequirementEntry> conflicting;  // with the other one
  std::map<RequirementEntry, std::string> unreachable;       // with the best, in percent
  std::map<std::size_t, std::string> unreachable_minimums;   // by task
  std::map<std::size_t, ConstraintSet> dead_tasks;           // with the reason
  std::map<std::size_t, ConstraintSet> dead_behaviors;       // with the reason
  std::map<RequirementEntry, ConstraintSet> redundant;       // with the reason
  std::vector<RequirementEntry> repeated;
  std::map<RequirementEntry, std::vector<std::size_t>> on_request;  // what to request, in order
};

// Lints a catalog. Throws std::runtime_error if it is not understood, or if a finding is not of a
// form that its rule has, stands in a wrong place, or is given twice.
Findings lint_findings(const LintOracle& oracle, const std::string& yaml);

// A degree as messages show it, without the sign: "72.5".
std::string percent_text(Millionths degree);

}  // namespace cbc::oracle
