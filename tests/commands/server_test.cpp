// The server of live pages, spoken to over sockets.
#include "page/serve/server.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <poll.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/http_client.h"

namespace cbc::serve::server_test {
namespace {

using namespace std::string_literals;
using test::Client;

class ServerTest : public testing::Test {
 protected:
  ServerTest() {
    history_.begin_part("0");
    auto [server, error] = Server::start({"127.0.0.1", 0}, site());
    EXPECT_EQ(error, "");
    server_ = std::move(server);
  }

  [[nodiscard]] Server::Site site() const {
    Server::Site site;
    site.page = [] { return "<!DOCTYPE html>"; };
    site.history = &history_;
    site.token = "TOKEN";
    return site;
  }

  [[nodiscard]] Client connect() const { return Client(server_->address().port); }
  /// The whole answer to a request.
  [[nodiscard]] std::string ask(std::string_view request) const {
    return connect().say(request).hear();
  }
  /// The first line of it.
  [[nodiscard]] std::string status_of(std::string_view request) const {
    const std::string answer = ask(request);
    return answer.substr(0, answer.find("\r\n"));
  }
  [[nodiscard]] Client listen(const std::string& more = {}) const {
    Client client = connect();
    client.say("GET /events?run=TOKEN HTTP/1.1\r\nHost: localhost\r\n" + more + "\r\n");
    return client;
  }
  void add(std::string_view data) {
    if (history_.wants_state()) history_.begin_part("state");
    history_.add("", data);
    server_->notify();
  }

  History history_{{100, std::size_t{1} << 20, 3}};
  std::unique_ptr<Server> server_;
};

TEST_F(ServerTest, SendsThePage) {
  EXPECT_FALSE(server_->was_visited());
  const std::string answer = ask("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\nContent-Type: text/html; charset=utf-8\r\n"));
  EXPECT_TRUE(answer.ends_with("\r\nContent-Length: 15\r\n\r\n<!DOCTYPE html>")) << answer;
  for (const char* const field :
       {"Cache-Control: no-store", "Content-Security-Policy: frame-ancestors 'none'",
        "Cross-Origin-Resource-Policy: same-origin", "X-Content-Type-Options: nosniff"}) {
    EXPECT_NE(answer.find(field), std::string::npos) << answer;
  }
  EXPECT_EQ(answer.find("Access-Control"), std::string::npos);
  EXPECT_TRUE(server_->was_visited());
}

TEST_F(ServerTest, AnswersNothingButGet) {
  for (const std::string method : {"POST", "HEAD", "PUT", "DELETE", "OPTIONS", "BREW"}) {
    const std::string answer =
        ask(method + " / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 3\r\n\r\nabc");
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 405 Method Not Allowed\r\n")) << answer;
    EXPECT_NE(answer.find("\r\nAllow: GET\r\n"), std::string::npos);
  }
  EXPECT_FALSE(server_->was_visited());
}

TEST_F(ServerTest, AnswersToItsOwnNames) {
  const auto status = [this](const std::string& fields) {
    return status_of("GET / HTTP/1.1\r\n" + fields + "\r\n");
  };
  EXPECT_EQ(status("Host: 127.0.0.1:1\r\n"), "HTTP/1.1 200 OK");
  EXPECT_EQ(status("Host: [::1]\r\n"), "HTTP/1.1 200 OK");
  EXPECT_EQ(status("Host: evil.example\r\n"), "HTTP/1.1 403 Forbidden");
  EXPECT_EQ(status(""), "HTTP/1.1 400 Bad Request");
  EXPECT_EQ(status("Host: localhost\r\nHost: evil.example\r\n"), "HTTP/1.1 400 Bad Request");
}

TEST_F(ServerTest, RefusesOtherRequests) {
  const auto status = [this](const std::string& target) {
    return status_of("GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  };
  EXPECT_EQ(status("/?x"), "HTTP/1.1 200 OK");
  EXPECT_EQ(status("/index.html"), "HTTP/1.1 404 Not Found");
  EXPECT_EQ(status("/../etc/passwd"), "HTTP/1.1 404 Not Found");
  EXPECT_EQ(status("/events"), "HTTP/1.1 404 Not Found");
  EXPECT_EQ(status("/events?run=OTHER"), "HTTP/1.1 404 Not Found");
  for (const std::string& garbage :
       {std::string("hello\r\n\r\n"), std::string(100, '\0') + "\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: " + std::string(100'000, 'x'),
        std::string("GET / HTTP/9.9\r\n\r\n"),
        "\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03 TLS\r\n\r\n"s}) {
    EXPECT_EQ(status_of(garbage), "HTTP/1.1 400 Bad Request");
  }
  EXPECT_EQ(status("/"), "HTTP/1.1 200 OK");
}

TEST_F(ServerTest, SendsWhatWasAndWhatComes) {
  add("one");
  Client client = listen();
  const std::string begin = client.hear("data: one\n\n");
  EXPECT_TRUE(begin.starts_with("HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\n"));
  EXPECT_NE(begin.find("\r\n\r\nretry: 1000\n\nevent: state\ndata: 0\n\nid: 1\ndata: one\n\n"),
            std::string::npos)
      << begin;
  add("two");
  EXPECT_TRUE(client.hear("data: two\n\n").ends_with("id: 2\ndata: two\n\n"));
  Client again = listen("Last-Event-ID: 1\r\n");
  EXPECT_TRUE(again.hear("data: two\n\n").ends_with("\r\n\r\nretry: 1000\n\nid: 2\ndata: two\n\n"));
}

TEST_F(ServerTest, EndsTheStreamsOfAll) {
  add("one");
  Client first = listen();
  Client second = listen();
  static_cast<void>(first.hear("data: one\n\n"));
  static_cast<void>(second.hear("data: one\n\n"));
  history_.add("end", "{}");
  history_.end();
  server_->notify();
  const Client silent = connect();  // says nothing; nobody waits for it
  server_->finish(std::chrono::seconds(20));
  EXPECT_TRUE(first.hear().ends_with("id: 2\nevent: end\ndata: {}\n\n"));
  EXPECT_TRUE(second.hear().ends_with("id: 2\nevent: end\ndata: {}\n\n"));
}

TEST_F(ServerTest, DoesNotWaitForSlowClients) {
  Client slow = listen();
  Client fast = listen();
  static_cast<void>(slow.hear("data: 0"));
  const std::string data(10'000, 'x');
  for (int i = 0; i < 3000; ++i) add(data);  // 30 MB, of which 3 are kept
  add("last");
  static_cast<void>(fast.hear("data: last\n\n"));
  // The slow one goes on, with what is left.
  const std::string text = slow.hear("data: last\n\n");
  EXPECT_LT(text.size(), 30'000'000U);
  EXPECT_TRUE(text.ends_with("id: 3001\ndata: last\n\n"));
}

TEST_F(ServerTest, ServesAFewOfVeryManyClients) {
  std::vector<Client> clients;
  clients.reserve(300);
  for (int i = 0; i < 300; ++i) clients.push_back(listen());
  add("one");
  int served = 0;
  int refused = 0;
  for (Client& client : clients) {
    const bool is_served = client.hear("data: one\n\n").starts_with("HTTP/1.1 200 OK");
    ++(is_served ? served : refused);
  }
  EXPECT_EQ(served, 100);
  EXPECT_EQ(refused, 200);
  clients.clear();
  // The server notices that they are gone.
  for (int i = 0; i < 1000; ++i) {
    if (ask("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n").starts_with("HTTP/1.1 200 OK")) return;
    ::poll(nullptr, 0, 10);
  }
  ADD_FAILURE() << "nobody is served any more";
}

TEST_F(ServerTest, ListensWhereItIsTold) {
  const auto [second, error] = Server::start(server_->address(), site());
  EXPECT_EQ(second, nullptr);
  EXPECT_EQ(error, "Address already in use");
  EXPECT_EQ(Server::start({"192.0.2.1", 0}, site()).second, "Cannot assign requested address");
}

TEST_F(ServerTest, SpeaksIpv6) {
  const auto [server, reason] = Server::start({"::1", 0}, site());
  if (server == nullptr) GTEST_SKIP() << "no IPv6 here: " << reason;
  EXPECT_EQ(to_url(server->address()),
            "http://[::1]:" + std::to_string(server->address().port) + "/");
}

}  // namespace
}  // namespace cbc::serve::server_test
