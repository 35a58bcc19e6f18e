#include "core/command_line/limits.h"

#include <charconv>
#include <string_view>
#include <system_error>
#include <unistd.h>

#include <fmt/core.h>

#include "core/words/words.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// A size of memory, as "512M", in bytes; empty if the text is none.
std::optional<std::uint64_t> parse_memory(const std::string& text) {
  constexpr std::string_view units = "KMGT";
  constexpr std::uint64_t most = std::uint64_t{1} << 60U;
  std::uint64_t size = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, size);
  if (error != std::errc() || size == 0) return std::nullopt;
  if (rest == end) return size;
  const std::size_t unit = units.find(*rest);
  if (unit == std::string_view::npos || rest + 1 != end) return std::nullopt;
  const auto shift = static_cast<unsigned>(10 * (unit + 1));
  if (size > most >> shift) return std::nullopt;
  return size << shift;
}

Values memory_size() {
  return {"SIZE", "a size of memory", [](const std::string& text) -> std::string {
            if (parse_memory(text)) return {};
            return fmt::format(
                "expected a number of bytes, or one with K, M, G or T, such as 8G, found {}",
                quote(text));
          }};
}

}  // namespace

std::vector<Option*> add_search_limits(Command& command, SearchLimits& limits) {
  return {&command.option("--max-solutions", limits.max_solutions, whole_number("M", 1),
                          "Take the best of the first M solutions, not of all"),
          &command.option("--max-nodes", limits.max_nodes, whole_number("N", 1),
                          "End the search of an event after N decisions"),
          &command.option("--max-clock-events", limits.max_clock_events, whole_number("N", 1),
                          "Give up after N clock events")};
}

CoordinatorOptions coordinator_options(const SearchLimits& limits) {
  CoordinatorOptions options;
  options.search.max_solutions = limits.max_solutions;
  options.search.max_nodes = limits.max_nodes;
  options.max_clock_events = limits.max_clock_events;
  return options;
}

Budget StateLimits::budget() const {
  Budget budget;
  budget.max_states = max_states;
  budget.max_memory = memory();
  budget.seconds = seconds();
  return budget;
}

std::uint64_t StateLimits::memory() const {
  if (!max_memory.empty()) return parse_memory(max_memory).value_or(0);
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long size = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || size <= 0) return 0;
  return static_cast<std::uint64_t>(pages) / 4 * 3 * static_cast<std::uint64_t>(size);
}

double StateLimits::seconds() const {
  return time_limit.empty() ? 0 : to_seconds(parse_seconds(time_limit).value);
}

std::vector<Option*> add_state_limits(Command& command, StateLimits& limits) {
  return {&command.option("--max-states", limits.max_states, whole_number("N", 1),
                          "End each exploration after N states"),
          &command.option("--max-memory", limits.max_memory, memory_size(),
                          "End it at this size of its states, such as 8G"),
          &command.option("--time-limit", limits.time_limit, seconds(),
                          "Stop all searches after this time")};
}

}  // namespace cbc::cli
