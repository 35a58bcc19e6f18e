#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sweep/counts.h"
#include "sweep/histogram.h"
#include "sweep/settings.h"

namespace cbc {

/// The event of a sweep that took most, in nodes or in time.
struct SlowestEvent {
  std::uint64_t sequence = 0;  ///< counts from 1
  std::uint64_t event = 0;     ///< index in its sequence
  std::uint64_t cost = 0;      ///< nodes, or nanoseconds
  std::string what;            ///< "start ROTATE"
  std::string script;          ///< that has this event as its last, or nearly so
};

/// What depends on the machine. A time is that of a whole event that took a search: the
/// question, the searches, the checks and the changes.
struct SweepTimes {
  std::uint64_t elapsed = 0;  ///< microseconds; of all shards together
  Histogram events;           ///< nanoseconds
  std::optional<SlowestEvent> slowest;
};

/// What a sweep, or a shard of one, found.
struct SweepResult {
  std::string catalog;  ///< the source, as it was named
  std::string digest;   ///< of what the catalog means, wherever it lies; hexadecimal
  std::string version;  ///< of cbc: another one may draw other events
  SweepSettings settings;
  std::vector<std::string> task_names;      ///< in catalog order
  std::vector<std::string> behavior_names;  ///< in catalog order
  SweepCounts counts;
  Histogram nodes;                      ///< of the events that took a search
  std::optional<SlowestEvent> slowest;  ///< by nodes: of equal ones the first; none: no search
  std::optional<SweepTimes> times;
};

/// The sequences of a shard: from `first` up to `end`, from 0.
struct SequenceRange {
  std::uint64_t first = 0;
  std::uint64_t end = 0;
};

[[nodiscard]] SequenceRange sequences_of(const SweepSettings& settings);

}  // namespace cbc
