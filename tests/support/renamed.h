#pragma once

#include <cstddef>
#include <string>

#include <nlohmann/json.hpp>

// What the tests of cbc rename compare.

namespace cbc::test {

/// With one name in place of another one, wherever it stands.
[[nodiscard]] inline std::string with_name(std::string text, const std::string& from,
                                           const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
  return text;
}

/// Messages say "task T" only if there is a behavior of this name, too.
inline void drop_messages(nlohmann::ordered_json& json) {
  if (json.is_object()) json.erase("message");
  if (!json.is_structured()) return;
  for (auto& part : json) drop_messages(part);
}

}  // namespace cbc::test
