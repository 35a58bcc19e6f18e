#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "page/serve/address.h"
#include "page/serve/history.h"

namespace cbc::serve {

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
