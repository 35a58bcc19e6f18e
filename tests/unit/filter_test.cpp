#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "core/support/system.h"

namespace cbc::filter_test {
namespace {

TEST(Filter, PassesAnyAmountThrough) {
  std::string text;
  for (int i = 0; i < 500'000; ++i) text += std::to_string(i) + '\n';
  const Filtered result = run_filter({"cat"}, text);
  EXPECT_TRUE(result.is_done);
  EXPECT_EQ(result.output, text);
  EXPECT_EQ(result.error_output, "");
}

TEST(Filter, SurvivesAProgramThatReadsNothing) {
  constexpr std::size_t more_than_a_pipe_holds = 10'000'000;
  const Filtered result = run_filter({"true"}, std::string(more_than_a_pipe_holds, 'x'));
  EXPECT_TRUE(result.is_done);
  EXPECT_EQ(result.output, "");
}

TEST(Filter, TellsFailures) {
  const Filtered failed = run_filter({"sh", "-c", "echo out; echo err >&2; exit 3"}, "");
  EXPECT_TRUE(failed.is_found);
  EXPECT_FALSE(failed.is_done);
  EXPECT_EQ(failed.output, "out\n");
  EXPECT_EQ(failed.error_output, "err\n");
  const Filtered killed = run_filter({"sh", "-c", "kill -9 $$"}, "");
  EXPECT_TRUE(killed.is_found);
  EXPECT_FALSE(killed.is_done);
  EXPECT_EQ(killed.error_output, "ended by signal 9");
  EXPECT_EQ(run_filter({"false"}, "").error_output, "exit status 1");
}

TEST(Filter, TellsThatThereIsNoProgram) {
  const Filtered result = run_filter({"no-such-program-anywhere"}, "text");
  EXPECT_FALSE(result.is_found);
  EXPECT_EQ(result.error_output, "No such file or directory");
  // What comes of it where the process starts first.
  EXPECT_FALSE(run_filter({"sh", "-c", "exit 127"}, "text").is_found);
}

}  // namespace
}  // namespace cbc::filter_test
