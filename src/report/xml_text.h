#pragma once

#include <string>
#include <string_view>

namespace cbc {

/// A text as content of an element or as value of an attribute in quotes. Line ends stay; other
/// control characters, bytes that are no UTF-8, and characters that XML 1.0 has no place for become
/// printable.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace cbc
