#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/coordinator.h"
#include "sweep/sequence.h"

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

/// A sweep may have this many shards at most, so that sums of their numbers fit.
inline constexpr std::uint64_t most_shards = 1000;
/// No number of a shard is larger.
inline constexpr std::uint64_t largest_count = std::uint64_t{1} << 53U;

/// Puts the shards of a sweep together, in any order, to the result of one run.
class SweepMerger {
 public:
  /// Takes a shard, which was read from `file`. Returns why it does not belong to the others, for
  /// people, or nothing.
  [[nodiscard]] std::optional<std::string> add(SweepResult shard, const std::string& file);
  /// Which shards are missing, for people, or nothing if all are there.
  [[nodiscard]] std::optional<std::string> find_missing() const;
  /// The result. All shards are there.
  [[nodiscard]] SweepResult take();

 private:
  [[nodiscard]] std::optional<std::string> find_difference(const SweepResult& shard) const;

  SweepResult merged_;
  std::map<std::uint64_t, std::string> files_;  ///< by index of the shard
};

/// A sequence that ended early, the first one that did.
struct SweepFailure {
  std::uint64_t sequence = 0;  ///< counts from 1
  Coordinator::Status status = Coordinator::Status::ok;
  std::string internal_error;  ///< if an answer was refused
  std::string script;          ///< the whole sequence
};

struct SweepOutcome {
  SweepResult result;  ///< means nothing after a failure
  std::optional<SweepFailure> failure;
};

/// Runs random event sequences on a catalog that has tasks. The result, but for its times, is the
/// same for any number of jobs (at least 1), and memory does not grow with the number of sequences.
/// `progress` is called now and then, in this thread, with the number of sequences done.
[[nodiscard]] SweepOutcome sweep(const CompiledCatalog& catalog, const SweepSettings& settings,
                                 std::size_t jobs,
                                 const std::function<void(std::uint64_t)>& progress);

}  // namespace cbc
