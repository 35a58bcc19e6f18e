#include "page/serve/server.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <future>
#include <new>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>

namespace cbc::serve {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using boost::system::error_code;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t most_connections = 100;
constexpr std::uint32_t longest_request = 16384;
constexpr seconds time_for_request(10);
constexpr seconds time_for_page(60);   // it may be long, as a text, and the network slow
constexpr seconds time_for_block(30);  // after it a client counts as stalled
constexpr seconds time_to_close(2);
constexpr std::size_t block_size = std::size_t{1} << 16;
/// Messages that come within this time are sent together.
constexpr milliseconds pause(20);
/// Messages about nothing, by which both sides see whether the connection is still there.
constexpr seconds time_between_signs(10);
constexpr const char* sign_of_life = "event: alive\ndata: 1\n\n";

/// The head of a response, after which the connection is closed.
std::string head(const char* status, const char* type, const std::string& more = {}) {
  return std::string("HTTP/1.1 ") + status + "\r\nContent-Type: " + type +
         "\r\nConnection: close\r\n"
         "Cache-Control: no-store\r\n"
         "Content-Security-Policy: frame-ancestors 'none'\r\n"
         "Cross-Origin-Resource-Policy: same-origin\r\n"
         "Referrer-Policy: no-referrer\r\n"
         "X-Content-Type-Options: nosniff\r\n" +
         more + "\r\n";
}

std::string length_of(std::string_view body) {
  return "Content-Length: " + std::to_string(body.size()) + "\r\n";
}

/// A response in words.
std::string answer(const char* status, const std::string& text, const std::string& more = {}) {
  const std::string body = text + "\n";
  return head(status, "text/plain; charset=utf-8", length_of(body) + more) + body;
}

std::string too_many() {
  return answer("503 Service Unavailable", "Too many pages of this run are open.");
}

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

/// What the thread of the server does.
class Server::Loop {
 public:
  explicit Loop(Site site) : site_(std::move(site)) {}

  /// Returns what went wrong, or nothing.
  std::string listen(const Address& wanted);
  void run();

  // From other threads.

  void notify() {
    if (has_listeners_ && !is_told_.exchange(true)) {
      asio::post(context_, [this] { send_after_pause(); });
    }
  }
  void finish(milliseconds longest);
  void stop() { context_.stop(); }

  Address address;
  std::atomic<bool> was_visited = false;

 private:
  class Connection;

  void accept();
  void send_after_pause();
  void send_all();
  void show_signs();
  void remove(Connection& connection);
  void look_whether_all_is_sent();

  const Site site_;
  std::set<Connection*> connections_;
  std::atomic<bool> has_listeners_ = false;     ///< some connection sends the history
  std::atomic<bool> is_told_ = false;           ///< a handler will look at the history
  std::shared_ptr<std::promise<void>> finish_;  ///< null unless finish() waits
  // Connections end with their handlers, before the members above.
  asio::io_context context_{1};
  tcp::acceptor acceptor_{context_};
  asio::steady_timer accept_timer_{context_};
  asio::steady_timer pause_timer_{context_};
  asio::steady_timer sign_timer_{context_};
};

/// One request and its response.
class Server::Loop::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Loop& loop, tcp::socket&& socket) : loop_(loop), stream_(std::move(socket)) {
    loop_.connections_.insert(this);
  }
  ~Connection() { loop_.remove(*this); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void begin() {
    parser_.header_limit(longest_request);
    parser_.body_limit(most_text);
    stream_.expires_after(time_for_request);
    http::async_read_header(
        stream_, buffer_, parser_,
        [self = shared_from_this()](error_code error, std::size_t) { self->respond(error); });
  }

  [[nodiscard]] bool is_listener() const { return reader_.has_value(); }
  /// Whether some of its response is still here.
  [[nodiscard]] bool is_sending() const { return is_sending_; }

  /// Sends what there is of the history, if nothing is being sent.
  void send_history() {
    if (!is_idle_) return;
    text_ = loop_.site_.history->read(*reader_, block_size);
    if (!text_.empty()) return send_block();
    if (loop_.site_.history->is_over(*reader_)) close();
  }

  void show_sign() {
    if (!is_idle_) return;
    text_ = sign_of_life;
    send_block();
  }

 private:
  void respond(error_code error) {
    if (is_gone(error)) return;
    is_sending_ = true;
    if (error) return send(refusal_of(error));
    const auto& request = parser_.get();
    const auto method = request.method();
    const Site& site = loop_.site_;
    if (method != http::verb::get && (method != http::verb::put || !site.put)) {
      return send(
          site.put ? answer("405 Method Not Allowed", "Only GET and PUT are answered.",
                            "Allow: GET, PUT\r\n")
                   : answer("405 Method Not Allowed", "Only GET is answered.", "Allow: GET\r\n"));
    }
    if (request.count(http::field::host) != 1) {
      return send(answer("400 Bad Request", "A request names one host."));
    }
    if (!may_answer_to(loop_.address.host, view_of(request[http::field::host]))) {
      return send(
          answer("403 Forbidden",
                 "This page is for this machine alone: open the address that was printed."));
    }
    std::string_view target = view_of(request.target());
    if (!target.starts_with(site.path)) {
      return send(answer("404 Not Found", "There is nothing but the page at the printed address."));
    }
    target.remove_prefix(site.path.size());
    method == http::verb::put ? read_text() : show(target);
  }

  /// `target`: relative to the page.
  void show(std::string_view target) {
    const std::string_view path = target.substr(0, target.find('?'));
    if (path.empty()) return send_page();
    if (loop_.site_.history != nullptr) {
      if (target == "events?run=" + loop_.site_.token) {
        return send_events(view_of(parser_.get()["Last-Event-ID"]));
      }
      if (path == "events") {
        return send(answer("404 Not Found", "This run is over; another one is shown here."));
      }
    }
    send(answer("404 Not Found", "There is nothing but the page at the printed address."));
  }

  /// Nobody is there, or what comes is not HTTP at all.
  static bool is_gone(error_code error) {
    const error_code of_request = http::error::bad_method;
    return error == http::error::end_of_stream ||
           (error && error.category() != of_request.category());
  }

  static std::string refusal_of(error_code error) {
    if (error != http::error::body_limit) {
      return answer("400 Bad Request", "This request cannot be understood.");
    }
    return answer("413 Payload Too Large",
                  "The text is larger than " + std::to_string(most_text >> 20U) + " MiB.");
  }

  /// Only the page itself may save: browsers say of each such request where it comes from.
  void read_text() {
    const auto& request = parser_.get();
    if (request.count(http::field::origin) != 1 ||
        view_of(request[http::field::origin]) !=
            "http://" + std::string(view_of(request[http::field::host]))) {
      return send(answer("403 Forbidden", "Only the page that is served here can save."));
    }
    stream_.expires_after(time_for_page);
    http::async_read(
        stream_, buffer_, parser_,
        [self = shared_from_this()](error_code error, std::size_t) { self->take_text(error); });
  }

  void take_text(error_code error) {
    if (is_gone(error)) return drop();
    if (error) return send(refusal_of(error));
    const auto& request = parser_.get();
    const std::string_view target = view_of(request.target()).substr(loop_.site_.path.size());
    const std::size_t end = std::min(target.find('?'), target.size());
    const Reply reply = loop_.site_.put(
        target.substr(0, end), target.substr(std::min(end + 1, target.size())), request.body());
    send(head(reply.status, "application/json", length_of(reply.json)) + reply.json);
  }

  void send_page() {
    loop_.was_visited = true;
    send(page_answer(), time_for_page);
  }

  [[nodiscard]] std::string page_answer() const {
    const std::string page = loop_.site_.page();
    return head("200 OK", "text/html; charset=utf-8", length_of(page)) + page;
  }

  void send(std::string text, seconds longest = time_for_block) {
    text_ = std::move(text);
    stream_.expires_after(longest);
    asio::async_write(stream_, asio::buffer(text_),
                      [self = shared_from_this()](error_code error, std::size_t) {
                        error ? self->drop() : self->close();
                      });
  }

  void send_events(std::string_view last_id) {
    reader_ = loop_.site_.history->reader_after(last_id);
    loop_.has_listeners_ = true;
    watch();
    text_ = head("200 OK", "text/event-stream") + "retry: 1000\n\n";
    send_block();
  }

  /// Notices when the browser leaves. It has nothing more to say.
  void watch() {
    stream_.expires_never();
    stream_.async_read_some(asio::buffer(rest_),
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (error != asio::error::operation_aborted) self->drop();
                            });
  }

  /// Sends the text, and goes on with the history.
  void send_block() {
    is_idle_ = false;
    stream_.expires_after(time_for_block);
    asio::async_write(stream_, asio::buffer(text_),
                      [self = shared_from_this()](error_code error, std::size_t) {
                        if (error) return self->drop();
                        self->is_idle_ = true;
                        self->send_history();
                      });
  }

  /// Closes the connection, and lets the other side do so first: otherwise it might lose what is on
  /// its way.
  void close() {
    is_idle_ = false;
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    is_sending_ = false;
    loop_.look_whether_all_is_sent();
    if (is_listener()) return;  // watch() is waiting
    stream_.expires_after(time_to_close);
    read_rest();
  }

  void read_rest() {
    stream_.async_read_some(asio::buffer(rest_),
                            [self = shared_from_this()](error_code error, std::size_t count) {
                              self->read_ += count;
                              if (!error && self->read_ < most_rest) self->read_rest();
                            });
  }

  void drop() {
    is_idle_ = false;
    is_sending_ = false;
    error_code ignored;
    stream_.socket().close(ignored);
    loop_.look_whether_all_is_sent();
  }

  static constexpr std::size_t most_rest = std::size_t{1} << 20;

  Loop& loop_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{longest_request};
  http::request_parser<http::string_body> parser_;
  std::string text_;  ///< that is being sent
  std::array<char, 4096> rest_{};
  std::size_t read_ = 0;                   ///< of the rest
  std::optional<History::Reader> reader_;  ///< if it is sent the history
  bool is_idle_ = false;                   ///< it has all that there is of the history
  bool is_sending_ = false;
};

std::string Server::Loop::listen(const Address& wanted) {
  error_code error;
  const tcp::endpoint end(asio::ip::make_address(wanted.host, error), wanted.port);
  if (!error) acceptor_.open(end.protocol(), error);
  if (!error) acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(end, error);
  if (!error) acceptor_.listen(tcp::acceptor::max_listen_connections, error);
  if (error) return error.message();
  address = {wanted.host, acceptor_.local_endpoint(error).port()};
  return error ? error.message() : std::string();
}

void Server::Loop::accept() {
  acceptor_.async_accept([this](error_code error, tcp::socket socket) {
    if (error) {  // there are too many open files, perhaps
      accept_timer_.expires_after(milliseconds(100));
      return accept_timer_.async_wait([this](error_code) { accept(); });
    }
    accept();
    error_code ignored;
    if (connections_.size() < most_connections) {
      socket.set_option(tcp::no_delay(true), ignored);
      std::make_shared<Connection>(*this, std::move(socket))->begin();
    } else {
      socket.non_blocking(true, ignored);
      socket.write_some(asio::buffer(too_many()), ignored);
    }
  });
}

void Server::Loop::send_after_pause() {
  pause_timer_.expires_after(pause);
  send_all();
  pause_timer_.async_wait([this](error_code) {
    is_told_ = false;
    send_all();  // what came during the pause
  });
}

void Server::Loop::send_all() {
  for (Connection* const connection : connections_) {
    if (connection->is_listener()) connection->send_history();
  }
}

void Server::Loop::show_signs() {
  sign_timer_.expires_after(time_between_signs);
  sign_timer_.async_wait([this](error_code) {
    for (Connection* const connection : connections_) {
      if (connection->is_listener()) connection->show_sign();
    }
    show_signs();
  });
}

void Server::Loop::remove(Connection& connection) {
  connections_.erase(&connection);
  has_listeners_ = std::any_of(connections_.begin(), connections_.end(),
                               [](const Connection* one) { return one->is_listener(); });
}

void Server::Loop::look_whether_all_is_sent() {
  if (finish_ == nullptr || std::any_of(connections_.begin(), connections_.end(),
                                        [](const Connection* one) { return one->is_sending(); })) {
    return;
  }
  finish_->set_value();
  finish_ = nullptr;
}

void Server::Loop::run() {
  accept();
  show_signs();
  while (!context_.stopped()) {
    try {
      context_.run();
    } catch (const std::bad_alloc&) {
      // One client will lack something; the others go on.
    }
  }
}

void Server::Loop::finish(milliseconds longest) {
  const auto promise = std::make_shared<std::promise<void>>();
  std::future<void> is_done = promise->get_future();
  asio::post(context_, [this, promise] {
    finish_ = promise;
    send_all();
    look_whether_all_is_sent();
  });
  is_done.wait_for(longest);
}

Server::Server(std::unique_ptr<Loop> loop) : loop_(std::move(loop)) {
  // Signals are for the thread that waits for input.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { loop_->run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Server::~Server() {
  loop_->stop();
  thread_.join();
}

std::pair<std::unique_ptr<Server>, std::string> Server::start(const Address& address, Site site) {
  auto loop = std::make_unique<Loop>(std::move(site));
  std::unique_ptr<Server> server;
  std::string error = loop->listen(address);
  try {
    if (error.empty()) server.reset(new Server(std::move(loop)));
  } catch (const std::system_error& no_thread) {
    error = no_thread.code().message();
  }
  return {std::move(server), std::move(error)};
}

const Address& Server::address() const { return loop_->address; }

bool Server::was_visited() const { return loop_->was_visited; }

void Server::notify() { loop_->notify(); }

void Server::finish(milliseconds longest) { loop_->finish(longest); }

}  // namespace cbc::serve
