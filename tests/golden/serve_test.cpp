// `cbc solve --format jsonl --serve`: a stream, and the page that shows it.
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <string>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/stream_text.h"
#include "support/http_client.h"
#include "support/scratch_folder.h"

namespace cbc::golden::serve_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A server-sent event.
struct Message {
  std::string type;
  std::string id;
  std::string data;
};

std::vector<Message> messages_in(const std::string& answer) {
  std::vector<Message> messages(1);
  for (const std::string& line : lines_of(answer.substr(answer.find("\r\n\r\n") + 4))) {
    if (line.starts_with("event: ")) messages.back().type = line.substr(7);
    if (line.starts_with("id: ")) messages.back().id = line.substr(4);
    if (line.starts_with("data: ")) messages.back().data = line.substr(6);
    if (line.empty() && !messages.back().data.empty()) messages.emplace_back();
  }
  messages.pop_back();
  return messages;
}

class ServeTest : public testing::Test {
 public:
  ServeTest(const ServeTest&) = delete;
  ServeTest& operator=(const ServeTest&) = delete;
  ~ServeTest() override {
    if (program_.joinable()) static_cast<void>(end());
  }

 protected:
  ServeTest() {
    fs::copy(fs::path(CBC_SOURCE_DIR) / "catalogs" / "quadrotor.yaml", folder_.path());
    EXPECT_EQ(::mkfifo((folder_ / "in").c_str(), 0600), 0);
    in_ = ::open((folder_ / "in").c_str(), O_RDWR | O_CLOEXEC);  // waits for nobody
  }

  /// Runs the program in a shell, with messages in "err"; its process is in "process".
  [[nodiscard]] int run(const std::string& more) const {
    const std::string command = "cd '" + folder_.path() +
                                "' && { '" CBC_PROGRAM_PATH
                                "' solve quadrotor.yaml - --format jsonl " +
                                more + " < in > out 2> err & echo $! > process; wait $!; }";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Begins a stream, and waits until its page is served.
  void begin(const std::string& more = {}) {
    program_ = std::thread([this, more] { status_ = run("--serve 127.0.0.1:0 " + more); });
    for (int i = 0; i < 2000 && port_.empty(); ++i) {
      ::poll(nullptr, 0, 10);
      if (!fs::exists(folder_ / "err")) continue;
      const std::string text = folder_.read("err");
      if (!text.ends_with("/\n")) continue;
      const std::string begin = "cbc: live page: http://127.0.0.1:";
      ASSERT_TRUE(text.starts_with(begin)) << text;
      port_ = text.substr(begin.size(), text.size() - begin.size() - 2);
    }
    ASSERT_FALSE(port_.empty()) << "no page is served";
  }
  void write(const std::string& events) const {
    ASSERT_EQ(::write(in_, events.data(), events.size()), static_cast<ssize_t>(events.size()));
  }
  /// Ends its input. Returns the exit status.
  [[nodiscard]] int end() {
    ::close(in_);
    program_.join();
    return status_;
  }

  [[nodiscard]] test::Client ask(const std::string& target, const std::string& more = {}) const {
    test::Client client(static_cast<std::uint16_t>(std::stoi(port_)));
    client.say("GET " + target + " HTTP/1.1\r\nHost: localhost:" + port_ + "\r\n" + more + "\r\n");
    return client;
  }
  /// The data of the page.
  [[nodiscard]] json page() const {
    const std::string text = ask("/").hear();
    EXPECT_NE(text.find("connect-src 'self';"), std::string::npos);
    return data_of_page(text);
  }
  [[nodiscard]] test::Client listen(const std::string& more = {}) const {
    return ask("/events?run=" + page()["live"].get<std::string>(), more);
  }

  const test::ScratchFolder folder_;
  std::string port_;

 private:
  int in_ = -1;
  std::thread program_;
  int status_ = -1;
};

constexpr const char* events =
    "{\"start\":\"TAKE_OFF\",\"priority\":2}\n"
    "{\"start\":\"HOVER\",\"wait\":0}\n"
    "no event\n"
    "{\"expect\":{\"stopped\":[\"TAKE_OFF\"]}}\n";

TEST_F(ServeTest, SendsTheLinesOfTheStream) {
  begin("--clock real");
  const json run = page();
  EXPECT_EQ(run["report"]["runs"][0]["catalog"], "quadrotor.yaml");
  EXPECT_EQ(run["report"]["runs"][0]["events"], json::array());
  test::Client early = listen();
  write(events);
  static_cast<void>(early.hear("event: failure\n"));
  test::Client late = listen();
  test::Client again = listen("Last-Event-ID: 2\r\n");
  // Who has not been answered when the stream ends may not be answered at all.
  static_cast<void>(late.hear("event: failure\n"));
  static_cast<void>(again.hear("event: failure\n"));
  EXPECT_EQ(end(), 2) << folder_.read("err");

  const std::vector<Message> messages = messages_in(early.hear());
  ASSERT_EQ(messages.size(), 6U);
  EXPECT_EQ(messages[0].type, "state");
  EXPECT_EQ(json::parse(messages[0].data)["index"], 0);
  const std::vector<std::string> lines = lines_of(folder_.read("out"));
  ASSERT_EQ(lines.size(), 4U);  // with the header
  EXPECT_EQ(messages[1].data, lines[1]);
  EXPECT_EQ(messages[2].data, lines[2]);
  EXPECT_EQ(messages[3].type, "refusal");
  EXPECT_EQ(messages[3].data, lines[3]);
  EXPECT_EQ(messages[4].type, "failure");
  const json failure = json::parse(messages[4].data);
  EXPECT_EQ(failure["index"], 2);
  EXPECT_EQ(failure["line"], 4);
  EXPECT_FALSE(failure["why"].empty()) << "the page explains it";
  EXPECT_EQ(messages[5].type, "end");
  EXPECT_EQ(messages[5].data, "{\"passed\":0,\"failed\":1}");

  EXPECT_EQ(messages_in(late.hear()).size(), 6U);
  const std::vector<Message> rest = messages_in(again.hear());
  ASSERT_EQ(rest.size(), 3U);
  EXPECT_EQ(rest[0].id, "3");
  EXPECT_EQ(lines_of(folder_.read("err")).size(), 2U) << "where the page is, and the expectation";
}

TEST_F(ServeTest, ChangesNothingElse) {
  begin();
  write(events);
  EXPECT_EQ(end(), 2);
  const std::string served = folder_.read("out");
  folder_.write("in2", events);
  const std::string command = "cd '" + folder_.path() +
                              "' && '" CBC_PROGRAM_PATH
                              "' solve quadrotor.yaml - --format jsonl < in2 > out2 2> /dev/null";
  static_cast<void>(std::system(command.c_str()));
  EXPECT_EQ(served, folder_.read("out2"));
  EXPECT_NE(folder_.read("err").find("the stream ended before a browser opened its page"),
            std::string::npos);
}

TEST_F(ServeTest, EndsWhenItIsAskedTo) {
  begin();
  write("{\"start\":\"TAKE_OFF\"}\n");
  test::Client client = listen();
  static_cast<void>(client.hear("id: 1\n"));
  ASSERT_EQ(std::system(("kill -TERM $(cat '" + (folder_ / "process") + "')").c_str()), 0);
  const std::vector<Message> messages = messages_in(client.hear());
  EXPECT_EQ(messages.back().type, "end");
  EXPECT_EQ(end(), 0);
}

TEST_F(ServeTest, ContinuesFromAState) {
  folder_.write("in2", "{\"start\":\"TAKE_OFF\"}\n{\"fault\":\"TAKE_OFF\"}\n");
  const std::string command =
      "cd '" + folder_.path() +
      "' && '" CBC_PROGRAM_PATH
      "' solve quadrotor.yaml - --format jsonl --state-out state < in2 > out";
  ASSERT_EQ(std::system(command.c_str()), 0);
  begin("--state-in state");
  const json state = page()["runs"][0]["state"];
  EXPECT_EQ(state["index"], 2);
  EXPECT_EQ(state["running"]["TAKE_OFF"], "TAKE_OFF");
  EXPECT_EQ(state["faulty"], json::array({"TAKE_OFF"}));
  EXPECT_EQ(state["requests"]["TAKE_OFF"], 1);
  EXPECT_EQ(end(), 0);
}

TEST_F(ServeTest, NeedsAFreePort) {
  begin();
  EXPECT_EQ(folder_.read("err"), "cbc: live page: http://127.0.0.1:" + port_ + "/\n");
  const std::string command = "cd '" + folder_.path() +
                              "' && '" CBC_PROGRAM_PATH
                              "' solve quadrotor.yaml - --format jsonl --serve localhost:" +
                              port_ + " < /dev/null > out2 2> err2";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(folder_.read("err2"), "cbc: --serve: cannot serve a page at 'localhost:" + port_ +
                                      "': Address already in use\n");
  EXPECT_EQ(folder_.read("out2"), "");
  EXPECT_EQ(end(), 0);
}

}  // namespace
}  // namespace cbc::golden::serve_test
