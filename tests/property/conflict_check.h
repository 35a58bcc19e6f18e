// Checks the `conflict` of every event by brute force: the relaxed problem of a rejected event is
// small enough to look at each of its assignments. Knows the state before an event from the events
// before it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "enumeration.h"
#include "model.h"
#include "statistics.h"

namespace cbc::oracle {

struct ConflictFault {
  std::size_t event = 0;  // its place in the events, from 0
  std::string what;
};

// The first conflict that is wrong, if one is. Statistics may be null.
std::optional<ConflictFault> check_conflicts(const CatalogFacts& facts, const Script& script,
                                             const nlohmann::ordered_json& events,
                                             Statistics* statistics);

}  // namespace cbc::oracle
