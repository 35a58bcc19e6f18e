#include "page/serve/history.h"

#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace cbc::serve::history_test {
namespace {

/// Everything that a reader gets, in blocks of a size.
std::string read_all(const History& history, History::Reader& reader, std::size_t block = 7) {
  std::string text;
  for (;;) {
    const std::string more = history.read(reader, block);
    EXPECT_LE(more.size(), block);
    if (more.empty()) return text;
    text += more;
  }
}

std::string read_after(const History& history, const std::string& id) {
  History::Reader reader = history.reader_after(id);
  return read_all(history, reader);
}

std::string state(int before) { return "event: state\ndata: " + std::to_string(before) + "\n\n"; }

std::string message(int id) {
  const std::string text = std::to_string(id);
  return "id: " + text + "\ndata: " + text + "\n\n";
}

/// Adds messages with their numbers as data, each part with the number before it.
void add_up_to(History& history, int& last, int wanted) {
  while (last < wanted) {
    if (history.wants_state()) history.begin_part(std::to_string(last));
    history.add("", std::to_string(++last));
  }
}

/// The numbers of the messages in a text.
std::vector<int> numbers_in(const std::string& text) {
  std::vector<int> numbers;
  for (std::size_t at = text.find("id: "); at != std::string::npos;
       at = text.find("id: ", at + 1)) {
    numbers.push_back(std::stoi(text.substr(at + 4)));
  }
  return numbers;
}

TEST(History, GivesLateReadersAllThatIsKept) {
  History history({3, 1000, 2});
  EXPECT_TRUE(history.wants_state());
  EXPECT_EQ(read_after(history, ""), "");
  int last = 0;
  add_up_to(history, last, 5);
  EXPECT_EQ(read_after(history, ""),
            state(0) + message(1) + message(2) + message(3) + state(3) + message(4) + message(5));
  add_up_to(history, last, 8);
  EXPECT_EQ(read_after(history, ""),
            state(3) + message(4) + message(5) + message(6) + state(6) + message(7) + message(8));
}

TEST(History, HasPartsOfLimitedSize) {
  History history({1000, 200, 3});
  for (int i = 0; i < 100; ++i) {
    if (history.wants_state()) history.begin_part("{}");
    history.add("failure", std::string(50, 'x'));
  }
  EXPECT_LT(read_after(history, "").size(), 3 * (200 + 100));
}

TEST(History, GoesOnAfterAnId) {
  History history({3, 1000, 2});
  int last = 0;
  add_up_to(history, last, 8);  // 4 to 8 are kept
  EXPECT_EQ(read_after(history, "7"), message(8));
  EXPECT_EQ(read_after(history, "6"), state(6) + message(7) + message(8));
  EXPECT_EQ(read_after(history, "5"), message(6) + state(6) + message(7) + message(8));
  EXPECT_EQ(read_after(history, "8"), "");
  const std::string all = read_after(history, "");
  for (const char* const id : {"0", "1", "3", "9", "18446744073709551616", "-1", "7x", "x"}) {
    EXPECT_EQ(read_after(history, id), all) << id;
  }
}

TEST(History, LetsSlowReadersMissParts) {
  History history({3, 1000, 2});
  int last = 0;
  add_up_to(history, last, 2);
  History::Reader reader = history.reader_after("");
  const std::string begin = history.read(reader, 20);
  add_up_to(history, last, 20);  // 16 to 20 are kept
  // It still gets what it has begun as a whole.
  EXPECT_EQ(begin + read_all(history, reader),
            state(0) + message(1) + message(2) + message(3) + state(15) + message(16) +
                message(17) + message(18) + state(18) + message(19) + message(20));
}

TEST(History, Ends) {
  History history({3, 1000, 2});
  int last = 0;
  add_up_to(history, last, 3);
  History::Reader reader = history.reader_after("");
  history.end();
  EXPECT_FALSE(history.is_over(reader));
  static_cast<void>(read_all(history, reader));
  EXPECT_TRUE(history.is_over(reader));
  EXPECT_TRUE(history.is_over(history.reader_after("3")));
  EXPECT_FALSE(history.is_over(history.reader_after("")));
}

/// Readers in another thread get messages in order, and after a gap the state first.
TEST(History, IsReadWhileItGrows) {
  History history({10, 100'000, 4});
  history.begin_part("0");
  constexpr int most = 20'000;
  std::thread writer([&history] {
    int last = 0;
    add_up_to(history, last, most);
    history.end();
  });
  std::string text;
  History::Reader reader = history.reader_after("");
  while (!history.is_over(reader)) text += history.read(reader, 1000);
  writer.join();
  const std::vector<int> numbers = numbers_in(text);
  ASSERT_FALSE(numbers.empty());
  EXPECT_EQ(numbers.back(), most);
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    ASSERT_GT(numbers[i], numbers[i - 1]);
    if (numbers[i] != numbers[i - 1] + 1) {
      ASSERT_NE(text.find(state(numbers[i] - 1) + message(numbers[i])), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace cbc::serve::history_test
