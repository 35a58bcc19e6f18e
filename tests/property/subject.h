// The implementation under test, behind one function.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include "statistics.h"

namespace cbc::oracle {

// The "events" that `cbc solve --format json` prints for one catalog and one script. Throws
// std::runtime_error with the diagnostics if the catalog or the script is refused.
nlohmann::ordered_json run_subject(const std::string& catalog_yaml, const std::string& script_yaml);

// The events, each with the explanations of all its tasks and behaviors ("why"), those of displaced
// tasks in the same form ("displaced"), and the best configurations ("alternatives").
nlohmann::ordered_json explain_subject(const std::string& catalog_yaml,
                                       const std::string& script_yaml, std::uint32_t alternatives);

// Handles each event of the script once more with very low limits, from the same state, and throws
// std::runtime_error if the answer is better than the proven one, or beyond its own bound, or
// missing where there must be one.
void check_limits(const std::string& catalog_yaml, const std::string& script_yaml,
                  Statistics& statistics);

}  // namespace cbc::oracle
