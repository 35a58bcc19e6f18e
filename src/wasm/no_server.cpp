#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "page/serve/server.h"

// In a browser there are no sockets, so no stream can be served.

namespace cbc::serve {

class Server::Loop {};

Server::Server(std::unique_ptr<Loop> loop) : loop_(std::move(loop)) {}

Server::~Server() = default;

std::pair<std::unique_ptr<Server>, std::string> Server::start(const Address& /*address*/,
                                                              Site /*site*/) {
  return {nullptr, "a browser cannot serve pages"};
}

const Address& Server::address() const {
  static const Address none;
  return none;
}

bool Server::was_visited() const { return false; }

void Server::notify() {}

void Server::finish(std::chrono::milliseconds /*longest*/) {}

}  // namespace cbc::serve
