#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// What the keys say that a task and a behavior need not have: docs/semantics.md, "Tasks and
/// behaviors". They stand in compiled files as they are here.
namespace cbc {

/// When a running task may get a behavior of higher suitability.
enum class Improve : std::uint8_t { at_events, at_once, when_started };
inline constexpr std::array<std::string_view, 3> improve_words{"at_events", "at_once",
                                                               "when_started"};

[[nodiscard]] constexpr std::string_view word_of(Improve value) {
  return improve_words[static_cast<std::size_t>(value)];
}

/// When a behavior that has failed is tried again.
enum class Retry : std::uint8_t { at_events, when_started, after_repair };
inline constexpr std::array<std::string_view, 3> retry_words{"at_events", "when_started",
                                                             "after_repair"};

[[nodiscard]] constexpr std::string_view word_of(Retry value) {
  return retry_words[static_cast<std::size_t>(value)];
}

struct TaskRules {
  std::int32_t reactive_priority = 0;  ///< of a reactive start
  std::uint8_t requestable = 1;        ///< flag
  Improve improve = Improve::at_events;
  std::uint8_t resume = 0;  ///< flag
  std::uint8_t unused = 0;

  friend bool operator==(const TaskRules&, const TaskRules&) = default;
};

}  // namespace cbc
