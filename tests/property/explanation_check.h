// Checks the explanations of accepted events by brute force: all solutions of the oracle, in order,
// say what the best configurations are, and where the best alternative loses; where there is none,
// all assignments say whether the reasons are a minimal set.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "model.h"
#include "statistics.h"

namespace cbc::oracle {

// `events`: as explain_subject() gives them, with at most `most` alternatives each. What is wrong
// first, if anything is.
std::optional<std::string> check_explanations(const Catalog& catalog, const Script& script,
                                              const nlohmann::ordered_json& events,
                                              std::size_t most, Statistics& statistics);

}  // namespace cbc::oracle
