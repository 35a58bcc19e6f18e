#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
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

/// Where pages are served unless something else is wanted.
inline constexpr const char* default_address = "127.0.0.1:8227";

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

/// A name that nobody can guess, of letters and digits.
[[nodiscard]] std::string make_token();

/// Texts that a page saves are at most this long, in bytes.
inline constexpr std::size_t most_text = std::size_t{20} << 20;

/// The reply to a page that saves a text.
struct Reply {
  const char* status;  ///< of HTTP: "200 OK"
  std::string json;
};

/// Shows a page to the browsers that ask for it; it may follow a history by server-sent events, and
/// may save texts. All this happens in one thread of its own, which nothing that a client does or
/// leaves undone can stop: each has a limited time for its request and for taking what it is sent,
/// and their number is limited. Nothing but GET is answered, and PUT of the page itself.
class Server {
 public:
  struct Site {
    /// Where the page is: it begins and ends with a slash. A name that nobody can guess keeps out
    /// the other users of the machine, too.
    std::string path = "/";
    /// Makes the page, HTML. This and `put` are called by the thread of the server.
    std::function<std::string()> page;
    /// That the page follows at "events?run=TOKEN"; null: it follows none. It must outlive the
    /// server.
    const History* history = nullptr;
    std::string token;  ///< another one is that of another run
    /// Takes a text that the page puts at "NAME?QUERY", relative to itself; null: it puts none.
    std::function<Reply(std::string_view name, std::string_view query, std::string_view text)> put;
  };

  /// Listens at an address; port 0 is a free one. Returns the server, or null and why there is
  /// none.
  [[nodiscard]] static std::pair<std::unique_ptr<Server>, std::string> start(const Address& address,
                                                                             Site site);

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
