#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cbc::serve {

/// Where a server listens.
struct Address {
  std::string host;  ///< numeric: "127.0.0.1", "::1"
  std::uint16_t port = 0;
};

/// Reads ADDRESS:PORT; the address of IPv6 is in brackets, and "localhost" is 127.0.0.1. Names are
/// not looked up. Empty if it is something else.
[[nodiscard]] std::optional<Address> read_address(std::string_view text);

/// The address of its page: "http://[::1]:8080/".
[[nodiscard]] std::string to_url(const Address& address);

/// Whether only this machine reaches it.
[[nodiscard]] bool is_loopback(std::string_view host);

/// Whether a request with this field "Host" may be answered by a server on `host`. One that only
/// this machine reaches answers to its own names alone: otherwise a page from anywhere could give
/// its name this address (DNS rebinding), and have the browser of a user read what is served. The
/// port does not matter, as it may be forwarded.
[[nodiscard]] bool may_answer_to(std::string_view host, std::string_view field);

}  // namespace cbc::serve
