#include "fuzz/target.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <unistd.h>

#include <fmt/core.h>

namespace cbc::fuzz {
namespace {

constexpr std::string_view separator = "%%%\n";

/// libFuzzer closes standard error while a target runs, so messages go to a copy.
const int messages = ::dup(STDERR_FILENO);

}  // namespace

std::span<const Target> targets() {
  static const std::array all = {catalog_target(),    compiled_target(), oracle_target(),
                                 properties_target(), replay_target(),   script_target(),
                                 settings_target(),   state_target(),    stream_target()};
  return all;
}

const Target* find_target(std::string_view name) {
  const auto all = targets();
  const auto found =
      std::find_if(all.begin(), all.end(), [name](const Target& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> seeds_of(const Target& target) {
  std::vector<std::string> seeds = target.seeds();
  std::set<std::string> known;
  std::erase_if(seeds, [&](const std::string& seed) {
    return seed.size() > target.longest || !known.insert(seed).second;
  });
  return seeds;
}

void fail(std::string_view why) {
  const std::string message = fmt::format("finding: {}\n", why);
  static_cast<void>(!::write(messages, message.data(), message.size()));
  std::abort();
}

std::vector<std::string> split_parts(std::string_view input) {
  std::vector<std::string> parts;
  for (;;) {
    std::size_t end = input.starts_with(separator) ? 0 : input.find("\n%%%\n");
    if (end == std::string_view::npos) break;
    if (!input.starts_with(separator)) ++end;
    parts.emplace_back(input.substr(0, end));
    input.remove_prefix(end + separator.size());
  }
  parts.emplace_back(input);
  return parts;
}

std::string join_parts(std::span<const std::string> parts) {
  std::string input;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    if (part > 0) {
      if (!input.empty() && input.back() != '\n') input += '\n';
      input += separator;
    }
    input += parts[part];
  }
  return input;
}

}  // namespace cbc::fuzz
