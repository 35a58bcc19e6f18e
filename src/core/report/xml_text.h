#pragma once

#include <string>
#include <string_view>

namespace cbc {

/// Escapes a text as content of an XML or HTML element or as a quoted attribute value. Line ends
/// are kept; other control characters, invalid UTF-8 and characters that XML 1.0 does not allow
/// become printable.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace cbc
