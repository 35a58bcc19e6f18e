#include "sweep/merge.h"

#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "text/quote.h"

namespace cbc {
namespace {

void keep_slower(std::optional<SlowestEvent>& slowest, std::optional<SlowestEvent> other) {
  if (!other) return;
  const bool is_slower =
      !slowest || other->cost > slowest->cost ||
      (other->cost == slowest->cost &&
       std::tie(other->sequence, other->event) < std::tie(slowest->sequence, slowest->event));
  if (is_slower) slowest = std::move(other);
}

}  // namespace

std::optional<std::string> SweepMerger::add(SweepResult shard, const std::string& file) {
  const std::uint64_t index = shard.settings.shard.index;
  if (files_.empty()) {
    merged_ = std::move(shard);
    files_[index] = file;
    return std::nullopt;
  }
  const std::string& first = files_.begin()->second;
  if (const auto difference = find_difference(shard)) {
    return fmt::format("{} does not belong to {}: {}", quote(file), quote(first), *difference);
  }
  if (const auto known = files_.find(index); known != files_.end()) {
    return fmt::format("{} is shard {}/{} again, after {}", quote(file), index,
                       shard.settings.shard.count, quote(known->second));
  }
  // The names of the source may differ; that of the first shard counts, in whatever order they
  // come.
  if (index < files_.begin()->first) merged_.catalog = std::move(shard.catalog);
  files_[index] = file;
  merged_.counts.add(shard.counts);
  merged_.nodes.add(shard.nodes);
  keep_slower(merged_.slowest, std::move(shard.slowest));
  if (merged_.times) {
    merged_.times->elapsed += shard.times->elapsed;
    merged_.times->events.add(shard.times->events);
    keep_slower(merged_.times->slowest, std::move(shard.times->slowest));
  }
  return std::nullopt;
}

/// What of a shard is not as in the others, though it has to be.
std::optional<std::string> SweepMerger::find_difference(const SweepResult& shard) const {
  const SweepSettings& ours = merged_.settings;
  const SweepSettings& theirs = shard.settings;
  const auto differs = [](std::string_view what, const auto& found, const auto& expected) {
    return fmt::format("its {} is {}, not {}", what, found, expected);
  };
  if (shard.version != merged_.version) {
    return differs("version of cbc", quote(shard.version), quote(merged_.version));
  }
  if (shard.digest != merged_.digest || shard.task_names != merged_.task_names ||
      shard.behavior_names != merged_.behavior_names) {
    return "it is of another catalog";
  }
  if (theirs.sequences != ours.sequences) {
    return differs("number of sequences", theirs.sequences, ours.sequences);
  }
  if (theirs.seed != ours.seed) return differs("seed", theirs.seed, ours.seed);
  if (theirs.shape != ours.shape || theirs.search != ours.search) return "its options are others";
  if (theirs.shard.count != ours.shard.count) {
    return differs("number of shards", theirs.shard.count, ours.shard.count);
  }
  if (shard.times.has_value() != merged_.times.has_value()) {
    return "only one of them was made with '--stats'";
  }
  return std::nullopt;
}

std::optional<std::string> SweepMerger::find_missing() const {
  constexpr std::size_t most_named = 10;
  const std::uint64_t count = merged_.settings.shard.count;
  std::string missing;
  std::size_t number = 0;
  for (std::uint64_t index = 1; index <= count; ++index) {
    if (files_.contains(index)) continue;
    ++number;
    if (number <= most_named)
      missing += fmt::format("{}{}/{}", number > 1 ? ", " : "", index, count);
  }
  if (number == 0) return std::nullopt;
  if (number > most_named) missing += fmt::format(" and {} more", number - most_named);
  return fmt::format("{} of the sweep {} missing: {}", number == 1 ? "a shard" : "shards",
                     number == 1 ? "is" : "are", missing);
}

SweepResult SweepMerger::take() {
  merged_.settings.shard = {};
  return std::move(merged_);
}

}  // namespace cbc
