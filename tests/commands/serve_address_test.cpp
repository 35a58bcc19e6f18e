#include <string>

#include <gtest/gtest.h>

#include "page/serve/server.h"

namespace cbc::serve::serve_address_test {
namespace {

std::string read(const std::string& text) {
  const auto address = read_address(text);
  return address ? to_url(*address) : "none";
}

TEST(ServeAddress, IsRead) {
  EXPECT_EQ(read("127.0.0.1:8080"), "http://127.0.0.1:8080/");
  EXPECT_EQ(read("localhost:0"), "http://127.0.0.1:0/");
  EXPECT_EQ(read("LocalHost:65535"), "http://127.0.0.1:65535/");
  EXPECT_EQ(read("0.0.0.0:80"), "http://0.0.0.0:80/");
  EXPECT_EQ(read("[::1]:8080"), "http://[::1]:8080/");
  EXPECT_EQ(read("[0:0:0:0:0:0:0:1]:8080"), "http://[::1]:8080/");
}

TEST(ServeAddress, IsRefused) {
  for (const char* const text : {"",
                                 "-",
                                 ":",
                                 "8080",
                                 ":8080",
                                 "127.0.0.1",
                                 "127.0.0.1:",
                                 "127.0.0.1:65536",
                                 "127.0.0.1:-1",
                                 "127.0.0.1:+1",
                                 "127.0.0.1: 1",
                                 "127.0.0.1:80x",
                                 "127.1:80",
                                 "256.0.0.1:80",
                                 "::1:8080",
                                 "[::1]",
                                 "[::1]8080",
                                 "[::1:8080",
                                 "[]:80",
                                 "[127.0.0.1]:80",
                                 "robot.local:8080",
                                 "localhost.:80",
                                 "[fe80::1%eth0]:80",
                                 "http://127.0.0.1:80",
                                 "127.0.0.1:80/"}) {
    EXPECT_EQ(read(text), "none") << text;
  }
}

/// The name of a page from elsewhere may be made to mean 127.0.0.1.
TEST(ServeAddress, AnswersToItsOwnNames) {
  for (const char* const host : {"127.0.0.1", "::1"}) {
    for (const char* const field : {"localhost", "localhost:8080", "LOCALHOST:1", "127.0.0.1:8080",
                                    "127.0.0.2", "[::1]", "[::1]:8080"}) {
      EXPECT_TRUE(may_answer_to(host, field)) << host << " " << field;
    }
    for (const char* const field :
         {"", "evil.example", "evil.example:8080", "localhost.evil.example",
          "127.0.0.1.evil.example", "192.168.0.1", "localhost:", "localhost:x", "[::1]x", "[::2]",
          "127.0.0.1:80:80", "::1"}) {
      EXPECT_FALSE(may_answer_to(host, field)) << host << " " << field;
    }
  }
  EXPECT_TRUE(may_answer_to("0.0.0.0", "robot.local:8080"));
}

}  // namespace
}  // namespace cbc::serve::serve_address_test
