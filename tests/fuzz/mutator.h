// Changes an input as the language of its target says. Plain changes of bytes mostly break YAML and
// JSON, and so reach little behind the parsers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/target.h"
#include "fuzz/tree.h"

namespace cbc::fuzz {

/// The words of tests/fuzz/dictionary.txt: keys, verbs, causes, values, names of rules.
[[nodiscard]] const std::vector<std::string>& dictionary();

/// Another input, of at most `most` bytes. The same seed gives the same, but for what
/// `mutate_bytes` does.
[[nodiscard]] std::string mutate(const Target& target, std::string_view input, std::size_t most,
                                 std::uint64_t seed, MutateBytes mutate_bytes);

}  // namespace cbc::fuzz
