// What is wrong with a command line is refused, whatever the command: what each option declares of
// others is tried, with values that the options accept, and so is what no option can take.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "support/whole_program.h"

namespace cbc::refusals_test {
namespace {

using cli::Command;
using cli::Option;
using Words = std::vector<std::string>;

const std::string existing_file = CBC_SOURCE_DIR "/README.md";

/// One that the option accepts, or one that it does not accept; empty if there is none.
std::string find_value(const Option& option, bool is_accepted) {
  const Words values = {"1",   ".",    "file",        "KEY=VALUE",
                        "1/2", "lost", "127.0.0.1:0", "no such value"};
  const auto found = std::find_if(values.begin(), values.end(), [&](const std::string& value) {
    return (!option.values.check || option.values.check(value).empty()) == is_accepted;
  });
  return found == values.end() ? std::string() : *found;
}

std::string value_of(const Option& option) {
  if (option.is_argument && option.values.is_input) return existing_file;
  if (!option.values.choices.empty()) return option.values.choices.front();
  return find_value(option, true);
}

/// A line that is complete, but for what is to be refused.
class Line {
 public:
  explicit Line(const Command& command) : command_(command), words_{command.name()} {
    for (const Option& option : command.options()) {
      if (option.is_argument && option.is_required) words_.push_back(value_of(option));
    }
  }

  /// `other` is named as the members of Option do it: "--script", "CATALOG", "--format json".
  void add(const std::string& other) {
    const std::size_t blank = other.find(' ');
    const Option& option = *command_.find(other.substr(0, blank));
    if (option.is_argument && option.is_required) return;
    if (!option.is_argument) words_.push_back(option.name());
    if (blank != std::string::npos) {
      words_.push_back(other.substr(blank + 1));
    } else if (!option.is_flag) {
      words_.push_back(value_of(option));
    }
  }

  /// With the first of what it needs, but for the row that is to be missing.
  void add_with_needs(const std::string& other, const Words* missing = nullptr) {
    add(other);
    for (const Words& needs : command_.find(other.substr(0, other.find(' ')))->requirements) {
      const std::string name = needs.front().substr(0, needs.front().find(' '));
      const bool is_there = std::find(words_.begin(), words_.end(), name) != words_.end();
      if (&needs != missing && !is_there) add_with_needs(needs.front());
    }
  }

  [[nodiscard]] Words with(const Words& further) const {
    Words words = words_;
    words.insert(words.end(), further.begin(), further.end());
    return words;
  }

 private:
  const Command& command_;
  Words words_;
};

class RefusalTest : public testing::Test {
 protected:
  /// The complaint has these texts.
  void expect_refusal(const Words& words, const Words& texts) const {
    testing::internal::CaptureStderr();
    const int status = program_.run(words);
    const std::string complaint = testing::internal::GetCapturedStderr();
    const std::string line = join(words, " ");
    EXPECT_EQ(status, cli::exit_unusable) << line;
    for (const std::string& text : texts) {
      EXPECT_NE(complaint.find(text), std::string::npos) << line << ": " << complaint;
    }
  }

  template <typename Try>
  void for_each_option(const Try& try_option) const {
    for (const Command& command : program_.commands()) {
      for (const Option& option : command.options()) try_option(command, option);
    }
  }

  const test::WholeProgram program_;
};

TEST_F(RefusalTest, OfWhatExcludesOneAnother) {
  for_each_option([&](const Command& command, const Option& option) {
    for (const auto& [others, reason] : option.exclusions) {
      for (const std::string& other : others) {
        Line line(command);
        line.add_with_needs(option.name());
        line.add_with_needs(other);
        expect_refusal(line.with({}), {option.name(), "cannot be used", reason});
      }
    }
  });
}

TEST_F(RefusalTest, OfWhatIsAlone) {
  for_each_option([&](const Command& command, const Option& option) {
    for (const Words& others : option.requirements) {
      Line line(command);
      line.add_with_needs(option.name(), &others);
      expect_refusal(line.with({}), {option.name(), "can only be used with"});
    }
  });
}

TEST_F(RefusalTest, OfWhatNeedsAnotherValue) {
  for_each_option([&](const Command& command, const Option& option) {
    for (const auto& [other, accepted] : option.accepted_values) {
      for (const std::string& value : command.find(other)->values.choices) {
        if (std::find(accepted.begin(), accepted.end(), value) != accepted.end()) continue;
        Line line(command);
        line.add_with_needs(option.name());
        expect_refusal(line.with({other, value}), {option.name(), "can only be used with"});
      }
    }
  });
}

TEST_F(RefusalTest, OfMissingValues) {
  for_each_option([&](const Command& command, const Option& option) {
    if (option.is_flag || option.is_argument || !option.missing_value.empty()) return;
    expect_refusal(Line(command).with({option.name()}), {option.name() + " needs "});
    expect_refusal(Line(command).with({option.name() + "="}), {option.name() + " needs "});
  });
}

TEST_F(RefusalTest, OfValuesThatFlagsDoNotTake) {
  for_each_option([&](const Command& command, const Option& option) {
    if (!option.is_flag) return;
    expect_refusal(Line(command).with({option.name() + "=1"}), {option.name() + " takes no value"});
  });
}

TEST_F(RefusalTest, OfWrongValues) {
  for_each_option([&](const Command& command, const Option& option) {
    const std::string value = find_value(option, false);
    if (option.is_argument || value.empty()) return;
    expect_refusal(Line(command).with({option.name(), value}), {option.name() + ": "});
  });
}

TEST_F(RefusalTest, OfOptionsThatAreGivenTwice) {
  for_each_option([&](const Command& command, const Option& option) {
    if (option.is_flag || option.is_argument || option.is_repeatable) return;
    const Words once = {option.name(), value_of(option)};
    expect_refusal(Line(command).with({once[0], once[1], once[0], once[1]}),
                   {option.name() + " is given more than once"});
  });
}

TEST_F(RefusalTest, OfOutputsThatWouldReplaceAnInput) {
  for_each_option([&](const Command& command, const Option& option) {
    if (!option.values.is_output) return;
    Words words = Line(command).with({option.name(), existing_file});
    if (words.size() == 3) words.push_back(existing_file);  // no argument is required
    expect_refusal(words, {"is also an input"});
  });
}

}  // namespace
}  // namespace cbc::refusals_test
