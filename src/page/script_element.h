#pragma once

#include <string>
#include <string_view>

namespace cbc {

/// Adds JSON to a script element, which ends at the first "</script" wherever it is, and is parsed
/// differently after "<!--". In JSON, "<" occurs in strings only.
inline void add_to_script_element(std::string& text, std::string_view json) {
  for (const char character : json) {
    if (character == '<') {
      text += "\\u003c";
    } else {
      text += character;
    }
  }
}

}  // namespace cbc
