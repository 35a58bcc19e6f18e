#pragma once

#include <arpa/inet.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <netinet/in.h>
#include <poll.h>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include <gtest/gtest.h>

namespace cbc::test {

/// A connection to a server on this machine, over which anything can be said.
class Client {
 public:
  explicit Client(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  Client(Client&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  ~Client() {
    if (socket_ >= 0) ::close(socket_);
  }

  Client& say(std::string_view text) {
    static_cast<void>(::send(socket_, text.data(), text.size(), MSG_NOSIGNAL));
    return *this;
  }
  /// Reads until a text has come; empty: until the connection ends.
  std::string hear(std::string_view wanted = {}) {
    std::array<char, 1 << 16> block{};
    while (wanted.empty() || heard_.find(wanted) == std::string::npos) {
      pollfd waiting{socket_, POLLIN, 0};
      if (::poll(&waiting, 1, patience) <= 0) {
        ADD_FAILURE() << "nothing comes after: " << heard_.substr(0, 1000);
        break;
      }
      const ssize_t count = ::recv(socket_, block.data(), block.size(), 0);
      if (count <= 0) break;
      heard_.append(block.data(), static_cast<std::size_t>(count));
    }
    return heard_;
  }

 private:
  static constexpr int patience = 20'000;  // milliseconds, after which something has gone wrong

  int socket_;
  std::string heard_;
};

}  // namespace cbc::test
