#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "page/serve/history.h"

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

/// Shows a page, which follows a history by server-sent events, to the browsers that ask for it.
/// All this happens in one thread of its own, which nothing that a client does or leaves undone can
/// stop: each has a limited time for its request and for taking what it is sent, and their number
/// is limited. Nothing but GET is answered.
class Server {
 public:
  struct Site {
    std::string page;   ///< HTML
    std::string token;  ///< of "/events?run=TOKEN"; another one is that of another run
  };

  /// Listens at an address; port 0 is a free one. Returns the server, or null and why there is
  /// none. `history` must outlive it.
  [[nodiscard]] static std::pair<std::unique_ptr<Server>, std::string> start(
      const Address& address, Site site, const History& history);

  /// Stops it at once.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Where it listens.
  [[nodiscard]] const Address& address() const;
  /// Whether a browser has asked for the page.
  [[nodiscard]] bool was_visited() const;

  /// Tells that the history has more, or has ended. This is quick.
  void notify();
  /// After the end of the history: waits until all have it, or for some time.
  void finish(std::chrono::milliseconds longest);

 private:
  class Loop;
  explicit Server(std::unique_ptr<Loop> loop);

  std::unique_ptr<Loop> loop_;
  std::thread thread_;
};

}  // namespace cbc::serve
