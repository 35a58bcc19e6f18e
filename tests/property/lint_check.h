// Holds the findings of the semantic rules against brute force.
#pragma once

#include <string>

#include "lint_findings.h"
#include "lint_oracle.h"
#include "statistics.h"

namespace cbc::oracle {

// Throws std::runtime_error with what is wrong: a finding that is not true or shows again what
// another one says, or something impossible that no finding explains.
void check_findings(const LintOracle& oracle, const Findings& findings, Statistics& statistics);

}  // namespace cbc::oracle
