#include "core/script/event_lines.h"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "unit/compiled_fixture.h"

namespace cbc::event_lines_test {
namespace {

class EventLinesTest : public testing::Test {
 protected:
  EventLines::Reading read(std::string_view line) { return lines_.read(line, 1); }

  const CompiledCatalog catalog_ = test::compile_text(
      "behaviors:\n- {behavior: a, task: A}\n- {behavior: b, task: B}\n"
      "tasks:\n- {task: A}\n- {task: B}\n");
  EventLines lines_{catalog_};
};

TEST_F(EventLinesTest, ReadsJsonAndYamlAlike) {
  for (const std::string_view line :
       {R"({"start": "B", "priority": 2, "parameters": {"x": [1, "y", null]}, "wait": 0.5})",
        "{start: B, priority: 2, parameters: {x: [1, y, ~]}, wait: 0.5}",
        "{\"start\": \"B\", \"priority\": 2, \"parameters\": {\"x\": [1, \"y\"]}, \"wait\": "
        "5e-1}\r",
        "{start: B, priority: 2, parameters: {x: [1, y]}, wait: 0.5}\r"}) {
    EventLines lines(catalog_);
    lines.resume(1'000'000, State(catalog_));
    const EventLines::Reading reading = lines.read(line, 1);
    ASSERT_TRUE(reading.step) << line << ": " << reading.error;
    EXPECT_EQ(reading.step->verb, Verb::start);
    EXPECT_EQ(reading.step->subject, 1U);
    EXPECT_EQ(reading.step->priority, 2);
    EXPECT_EQ(reading.step->time, 1'500'000);
    ASSERT_TRUE(reading.step->parameters);
    EXPECT_EQ(reading.step->parameters->canonical, "m1:s1:xl2:s1:1s1:y");
  }
}

TEST_F(EventLinesTest, KnowsTheSituationThatItGoesOnFrom) {
  constexpr std::string_view line = R"({"finish": "b", "cause": "situation_change"})";
  EXPECT_EQ(read(line).warnings.size(), 1U) << "it is still available";
  State state(catalog_);
  state.set_denied(catalog_.behavior_ids[1], true);
  lines_.resume(0, state);
  EXPECT_TRUE(read(line).warnings.empty());
}

TEST_F(EventLinesTest, PassesOverEmptyLinesAndComments) {
  for (const std::string_view line : {"", "  \t", "\r", " \r", "# a comment", "# a comment\r"}) {
    const EventLines::Reading reading = read(line);
    EXPECT_FALSE(reading.step);
    EXPECT_EQ(reading.error, "");
  }
}

TEST_F(EventLinesTest, SaysWhatIsWrong) {
  const auto error = [this](std::string_view line) {
    const EventLines::Reading reading = read(line);
    EXPECT_FALSE(reading.step);
    return reading.error;
  };
  EXPECT_EQ(error(R"({"start": "C"})"), error("{start: C}"));
  EXPECT_NE(error(R"({"start": "C"})").find("there is no task 'C'"), std::string::npos);
  EXPECT_NE(error(R"({"start": "A", "stop": "A"})"), "");
  EXPECT_NE(error(R"({"start": "A", "start": "A"})"), "");
  EXPECT_NE(error(R"({"start": "A", "priority": 0})"), "");
  EXPECT_NE(error(R"({"start": "A", "unknown": 0})"), "");
  EXPECT_NE(error(R"({"start": "A")"), "");
  EXPECT_NE(error("[]"), "");
  EXPECT_NE(error("null"), "");
  EXPECT_NE(error("5"), "");
  EXPECT_NE(error("\xff"), "");
  EXPECT_NE(error(std::string("\0", 1)), "");
}

TEST_F(EventLinesTest, GoesOnFromTheStateAfterAnError) {
  const State state(catalog_);
  EXPECT_FALSE(read(R"({"start": "C", "at": 5})").step);
  lines_.resume(1'000'000, state);
  const EventLines::Reading reading = read(R"({"start": "A", "at": 2})");
  ASSERT_TRUE(reading.step) << reading.error;
  EXPECT_EQ(reading.step->time, 2'000'000);
}

}  // namespace
}  // namespace cbc::event_lines_test
