// The implementation under test, behind one function.
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

namespace cbc::oracle {

// The "events" that `cbc solve --format json` prints for one catalog and one script. Throws
// std::runtime_error with the diagnostics if the catalog or the script is refused.
nlohmann::ordered_json run_subject(const std::string& catalog_yaml, const std::string& script_yaml);

// The events, each with the explanations of all its tasks and behaviors ("why"), those of displaced
// tasks in the same form ("displaced"), and the best configurations ("alternatives").
nlohmann::ordered_json explain_subject(const std::string& catalog_yaml,
                                       const std::string& script_yaml, std::uint32_t alternatives);

}  // namespace cbc::oracle
