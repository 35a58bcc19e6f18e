#pragma once

#include <string>
#include <string_view>

namespace cbc {

/// The path of a URI (RFC 3986) for the path of a file: every byte but letters, digits, "-._~" and
/// "/" is percent-encoded.
[[nodiscard]] std::string percent_encode(std::string_view path);

}  // namespace cbc
