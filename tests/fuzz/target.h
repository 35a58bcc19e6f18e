// What can be fuzzed: functions of the program that take the bytes of others, each with inputs to
// begin with. libFuzzer drives them (fuzzer.cpp), and the ordinary tests run all inputs that are
// kept (corpus_test.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cbc::fuzz {

/// What an input consists of, which says how it is mutated.
enum class Language : std::uint8_t {
  bytes,      ///< anything
  yaml,       ///< parts, each a YAML document
  json,       ///< parts, each a JSON text
  json_lines  ///< parts, each with a JSON text on every line
};

struct Target {
  std::string_view name;
  std::string_view what;  ///< is fed, for people
  Language language = Language::bytes;
  /// The first parts stay as they are: they are the catalog that the others are about.
  std::size_t fixed_parts = 0;
  std::size_t longest = 4096;  ///< size of an input
  /// Runs an input. Whatever must not happen ends the process: see fail().
  void (*run)(const std::string& input) = nullptr;
  /// Inputs to begin with, made from files and tables of the project. Those that are too long are
  /// left out by whoever asks.
  std::vector<std::string> (*seeds)() = nullptr;
};

[[nodiscard]] std::span<const Target> targets();
/// Null if there is none of the name.
[[nodiscard]] const Target* find_target(std::string_view name);

/// The inputs of `target.seeds` that are short enough, without repetitions.
[[nodiscard]] std::vector<std::string> seeds_of(const Target& target);

/// A finding: prints why, and aborts.
[[noreturn]] void fail(std::string_view why);
inline void require(bool holds, std::string_view why) {
  if (!holds) fail(why);
}

/// Parts of an input are separated by lines with three percent signs.
[[nodiscard]] std::vector<std::string> split_parts(std::string_view input);
[[nodiscard]] std::string join_parts(std::span<const std::string> parts);

// The targets, each in a file of its own.

[[nodiscard]] Target catalog_target();
[[nodiscard]] Target compiled_target();
[[nodiscard]] Target oracle_target();
[[nodiscard]] Target properties_target();
[[nodiscard]] Target replay_target();
[[nodiscard]] Target script_target();
[[nodiscard]] Target settings_target();
[[nodiscard]] Target state_target();
[[nodiscard]] Target stream_target();

}  // namespace cbc::fuzz
