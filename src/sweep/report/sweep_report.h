#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/diagnostic/diagnostic.h"
#include "sweep/engine/sweep.h"

// The reports of `cbc sweep`.

namespace cbc {

/// The result of a sweep, schema cbc.sweep/1; "stats" is there if the result has times.
///
///   sequences, seed, options, shard   what was run; {"index": 1, "count": 1} is a whole sweep
///   digest         of the compiled catalog without the name of its file
///   events         by kind, in this order, how many had which outcome; "escalated" counts the
///                  accepted ones at a protection level above the first
///   tasks          in catalog order: start events of scripts that were accepted ("started") or
///                  rejected, and how often the task started to run, for whatever reason ("runs")
///   behaviors      in catalog order: activations that succeeded (but for undone ones) and failed
///   never_ran, never_active    the tasks, the behaviors with none of these
///   reasons        in how many rejections each reason had a part, whatever the priorities; the
///                  members are those of "conflict" of cbc.solve/1
///   nodes          of the events that took a search: median (p50), 99th percentile and maximum;
///                  histogram: [number, count], numbers from 1024 on rounded down to 10 binary
///                  digits, as are the percentiles then
///   slowest        the first event with the most nodes, and a script to reproduce it, or null;
///                  sequence and event count from 1
///   stats          elapsed time, summed over shards [µs]; times of the events that took a search,
///                  and the slowest of them [ns]
[[nodiscard]] std::string sweep_to_json(const SweepResult& result);

/// Reads what sweep_to_json wrote. Whatever the text, the result may be merged and reported; if it
/// cannot be understood, the second alternative says why, for people.
[[nodiscard]] std::variant<SweepResult, std::string> sweep_from_json(std::string_view text);

/// The result of a sweep for people.
[[nodiscard]] std::string sweep_to_text(const SweepResult& result, const Style& style);

/// A format of `cbc sweep`.
struct SweepFormat {
  std::string_view name;
  std::string (*write)(const SweepResult& result, const Style& style);
};

/// The first one is the default.
[[nodiscard]] std::span<const SweepFormat> sweep_formats();

}  // namespace cbc
