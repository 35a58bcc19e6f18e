#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <netinet/in.h>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "page/serve/server.h"

namespace cbc::serve {
namespace {

/// "HOST:PORT" or "HOST", in two parts; a host in brackets keeps them.
std::pair<std::string_view, std::string_view> split_port(std::string_view text) {
  const std::size_t end = text.starts_with('[') ? text.find(']') : text.find(':');
  if (end == std::string_view::npos) return {text, {}};
  const std::size_t colon = text[end] == ']' ? end + 1 : end;
  return {text.substr(0, colon), text.substr(colon)};
}

std::optional<std::uint16_t> read_port(std::string_view text) {
  std::uint16_t port = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, port);
  if (error != std::errc() || stop != end) return std::nullopt;
  return port;
}

/// The way it is usually written, or empty if it is no address of the family.
std::string normalize(int family, const std::string& host) {
  in6_addr address{};
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (::inet_pton(family, host.c_str(), &address) != 1) return {};
  return ::inet_ntop(family, &address, text.data(), text.size());
}

bool is_localhost(std::string_view host) {
  constexpr std::string_view name = "localhost";
  return std::equal(host.begin(), host.end(), name.begin(), name.end(), [](char one, char other) {
    return (one >= 'A' && one <= 'Z' ? static_cast<char>(one - 'A' + 'a') : one) == other;
  });
}

/// As in an address of a page: in brackets or not. Empty if it is no numeric address.
std::string read_host(std::string_view text) {
  if (text.starts_with('[') && text.ends_with(']')) {
    return normalize(AF_INET6, std::string(text.substr(1, text.size() - 2)));
  }
  return normalize(AF_INET, std::string(text));
}

}  // namespace

std::optional<Address> read_address(std::string_view text) {
  const auto [host, rest] = split_port(text);
  if (!rest.starts_with(':')) return std::nullopt;
  const auto port = read_port(rest.substr(1));
  Address address{is_localhost(host) ? "127.0.0.1" : read_host(host), port.value_or(0)};
  if (!port || address.host.empty()) return std::nullopt;
  return address;
}

std::string to_url(const Address& address) {
  const bool is_ipv6 = address.host.find(':') != std::string::npos;
  return "http://" + (is_ipv6 ? "[" + address.host + "]" : address.host) + ":" +
         std::to_string(address.port) + "/";
}

bool is_loopback(std::string_view host) { return host.starts_with("127.") || host == "::1"; }

bool may_answer_to(std::string_view host, std::string_view field) {
  if (!is_loopback(host)) return true;
  const auto [name, port] = split_port(field);
  if (!port.empty() && (!port.starts_with(':') || !read_port(port.substr(1)))) return false;
  return is_localhost(name) || is_loopback(read_host(name));
}

}  // namespace cbc::serve
