#include "cli/sweep_options.h"

#include <charconv>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/validators.h"
#include "cli/value_kind.h"
#include "sweep/merge.h"
#include "text/decimal.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

constexpr std::int64_t most_sequences = 1'000'000'000;
constexpr std::int64_t most_events = 1'000'000;

Decimal parse_probability(const std::string& text) {
  return parse_decimal(text, 6, 0, one_million);
}

CLI::Validator probability() {
  const auto check = [](const std::string& text) -> std::string {
    if (parse_probability(text).error == DecimalError::no_error) return {};
    return fmt::format("expected a number from 0 to 1, with at most 6 decimals, found {}",
                       quote(text));
  };
  return {check, ""};
}

/// "2/8"; empty if it is none.
std::optional<SweepShard> parse_shard(const std::string& text) {
  SweepShard shard;
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  if (index.ec != std::errc() || index.ptr == end || *index.ptr != '/') return std::nullopt;
  const auto count = std::from_chars(index.ptr + 1, end, shard.count);
  if (count.ec != std::errc() || count.ptr != end) return std::nullopt;
  if (shard.index < 1 || shard.index > shard.count || shard.count > most_shards) {
    return std::nullopt;
  }
  return shard;
}

CLI::Validator shard_of_sweep() {
  const auto check = [](const std::string& text) -> std::string {
    if (parse_shard(text)) return {};
    return fmt::format("expected I/N, such as 3/8, with I from 1 to N and N at most {}, found {}",
                       most_shards, quote(text));
  };
  return {check, ""};
}

}  // namespace

void add_sweep_options(CLI::App& command, SweepOptions& options) {
  CLI::Option* const sweep =
      command
          .add_option("--sweep", options.sequences,
                      "Run N random event sequences on the catalog instead of scripts, and report "
                      "what happened in them")
          ->option_text("N")
          ->check(whole_number(1, most_sequences));
  const auto add = [&](const char* name, auto& value, const char* text, const char* help) {
    return command.add_option(name, value, help)->option_text(text)->needs(sweep);
  };
  add("--seed", options.seed, "S", "Draw other sequences (default: 1)")->check(whole_number(0));
  add("--events", options.events, "E", "Events in each sequence (default: 100)")
      ->check(whole_number(1, most_events));
  add("--priorities", options.priorities, "P", "Requests have priorities from 1 to P (default: 3)")
      ->check(whole_number(1, 1'000'000));
  add("--failures", options.failures, "SHARE",
      "Of the finished behaviors, from 0 to 1, how many have failed (default: 0.3)")
      ->check(probability());
  add("--faults", options.faults, "SHARE",
      "Of the events, from 0 to 1, how many are faults, repairs and changes of the situation "
      "(default: 0.1)")
      ->check(probability());
  add("--shard", options.shard, "I/N", "Run the I-th of N shares of the sweep only")
      ->check(shard_of_sweep());
  CLI::Option* const merge = command
                                 .add_flag("--merge", options.merge,
                                           "Merge the files: the results of all shards, as JSON, "
                                           "become that of one run")
                                 ->option_text(" ")
                                 ->check(stands_for(ValueKind::shard));
  command
      .add_option("--slowest", options.slowest,
                  "Write the event with the most nodes to FILE, as a script that ends with it")
      ->option_text("FILE")
      ->check(stands_for(ValueKind::file));
  command
      .add_option("--slowest-by-time", options.slowest_by_time,
                  "The same for the event that took longest")
      ->option_text("FILE")
      ->check(stands_for(ValueKind::file));
  sweep->excludes(merge);
}

SweepSettings settings_of(const SweepOptions& options) {
  SweepSettings settings;
  settings.sequences = options.sequences.value_or(1);
  settings.seed = options.seed;
  settings.shape.events = options.events;
  settings.shape.priorities = options.priorities;
  settings.shape.failures = static_cast<Millionths>(parse_probability(options.failures).value);
  settings.shape.faults = static_cast<Millionths>(parse_probability(options.faults).value);
  settings.shard = parse_shard(options.shard).value_or(SweepShard{});
  return settings;
}

}  // namespace cbc::cli
