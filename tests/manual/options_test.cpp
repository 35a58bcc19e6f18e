// The pages of the commands have the forms and the options that the command line declares, and the
// first paragraph about an option is what is declared of it: what it means, and what it goes with.
// What follows that paragraph is written in the page. After a change of the declarations this
// writes the rest anew:
//
//   CBC_UPDATE_GOLDEN=1 build/release/tests/cbc_manual_tests
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "core/command_line/command_line.h"
#include "manual/page.h"
#include "support/whole_program.h"

namespace cbc::manual::options_test {
namespace {

using cli::Command;
using cli::Option;

/// Small commands have no page of their own.
bool has_page(const Command& command) {
  return std::filesystem::exists(fmt::format("{}/man/cbc-{}.1", CBC_SOURCE_DIR, command.name()));
}

std::string page_of(const Command& command) { return "cbc-" + command.name() + ".1"; }

/// A word of a form of the command line: "--diff", "SCRIPT...", "task".
std::string marked_up(std::string word) {
  if (word.starts_with("--")) return "Fl " + word.substr(1);
  if (word.ends_with("...")) word.insert(word.size() - 3, " ");
  return (std::isupper(static_cast<unsigned char>(word.front())) != 0 ? "Ar " : "Cm ") + word;
}

std::string synopsis_of(const Command& command) {
  std::string text;
  for (const std::string& usage : command.text().usages) {
    text += ".Nm cbc " + command.name() + '\n';
    for (std::string_view word : cli::split(usage, ' ')) {
      const bool is_optional = word.starts_with('[');
      if (is_optional) word = word.substr(1, word.size() - 2);
      std::string line;
      for (const std::string_view choice : cli::split(word, '|')) {
        line += (line.empty() ? "" : " | ") + marked_up(std::string(choice));
      }
      text += (is_optional ? ".Op " : ".") + line + '\n';
    }
  }
  return text;
}

std::string item_of(const Option& option) {
  std::string line = ".It";
  for (const std::string& name : option.names) {
    line += (&name == &option.names.front() ? " Fl " : " , Fl ") + name.substr(1);
  }
  std::string value = option.values.placeholder;
  if (value.starts_with('[')) value = value.substr(1, value.size() - 2);
  if (!value.empty()) line += (option.missing_value.empty() ? " Ar " : " Op Ar ") + value;
  return line + '\n';
}

/// What it means, and what it goes with.
std::string declared_of(const Option& option) {
  std::string text = option.meaning() + '.';
  for (const std::vector<std::string>& others : option.requirements) {
    text += fmt::format(" Only with {}.", cli::join_with_or(others));
  }
  for (const auto& [other, values] : option.accepted_values) {
    text += fmt::format(" Only with {} {}.", other, cli::join_with_or(values));
  }
  for (const auto& [others, reason] : option.exclusions) {
    text += fmt::format(" Not with {}{}.", cli::join_with_or(others),
                        reason.empty() ? "" : ": " + reason);
  }
  return prose(text);
}

/// All that a page says of options beside what is declared.
struct PageProse {
  std::map<std::string, std::string> of_options;  ///< by the longest name
  std::map<std::string, std::string> before;      ///< by group, before the list of its options
  std::map<std::string, std::string> after;
};

PageProse read_prose(std::string_view section) {
  PageProse found;
  std::string group = "Options";
  std::string* place = &found.before[group];
  bool is_declared = false;
  int depth = 0;
  while (!section.empty()) {
    const std::string line(take_until("\n", section));
    if (line.starts_with(".Ss ")) {
      group = line.substr(4);
      place = &found.before[group];
    } else if (line.starts_with(".Bl") && depth++ == 0) {
      continue;
    } else if (line == ".El" && --depth == 0) {
      place = &found.after[group];
      is_declared = false;
    } else if (depth == 1 && line.starts_with(".It ")) {
      std::string_view rest(line);
      take_until("Fl -", rest);
      place = &found.of_options["--" + std::string(take_until(" ", rest))];
      is_declared = true;
    } else {
      is_declared = is_declared && line != ".Pp" && !line.starts_with(".Bl");
      if (!is_declared) *place += line + '\n';
    }
  }
  return found;
}

std::string options_section(const Command& command, const PageProse& from_page) {
  const auto find = [](const std::map<std::string, std::string>& texts, const std::string& key) {
    const auto found = texts.find(key);
    return found == texts.end() ? std::string() : found->second;
  };
  std::string text;
  std::string group;
  const auto end_group = [&] {
    if (!group.empty()) text += ".El\n" + find(from_page.after, group);
  };
  for (const Option& option : command.options()) {
    if (option.is_argument) continue;
    if (option.group != group) {
      end_group();
      group = option.group;
      if (group != "Options") text += ".Ss " + group + '\n';
      text += find(from_page.before, group) + ".Bl -tag -width Ds\n";
    }
    text += item_of(option) + declared_of(option) + find(from_page.of_options, option.name());
  }
  end_group();
  return text;
}

class PageTest : public testing::Test {
 protected:
  const test::WholeProgram program_;
};

TEST_F(PageTest, HasTheFormsOfTheCommand) {
  for (const Command& command : program_.commands()) {
    if (!has_page(command)) continue;
    expect_part(page_of(command), ".Sh SYNOPSIS", ".Sh ", synopsis_of(command));
  }
}

TEST_F(PageTest, HasTheOptionsOfTheCommand) {
  for (const Command& command : program_.commands()) {
    if (!has_page(command)) continue;
    const std::string page = read_page(page_of(command));
    const PageProse from_page = read_prose(between(page, ".Sh OPTIONS", ".Sh "));
    expect_part(page_of(command), ".Sh OPTIONS", ".Sh ", options_section(command, from_page));
  }
}

TEST_F(PageTest, ExplainsNoWordThatAnOptionDoesNotTake) {
  for (const Command& command : program_.commands()) {
    if (!has_page(command)) continue;
    const std::string page = read_page(page_of(command));
    const PageProse from_page = read_prose(between(page, ".Sh OPTIONS", ".Sh "));
    for (const Option& option : command.options()) {
      const std::vector<std::string>& known = option.values.choices;
      const auto text = from_page.of_options.find(option.name());
      if (known.empty() || text == from_page.of_options.end()) continue;
      for (const std::string& word : items(text->second, "Ic")) {
        EXPECT_TRUE(std::find(known.begin(), known.end(), word) != known.end())
            << page_of(command) << ": " << option.name() << " has no " << word;
      }
    }
  }
}

TEST_F(PageTest, HasTheExitStatusesOfTheCommand) {
  const std::regex status("[0-9]");
  for (const Command& command : program_.commands()) {
    if (!has_page(command)) continue;
    std::string_view footer = command.text().footer;
    take_until("Exit status: ", footer);
    const std::string text(take_until("\n\n", footer));
    std::set<std::string> declared;
    for (std::sregex_iterator found(text.begin(), text.end(), status), end; found != end; ++found) {
      declared.insert(found->str());
    }
    const std::string page = read_page(page_of(command));
    std::set<std::string> listed;
    std::string_view section = between(page, ".Sh EXIT STATUS", ".Sh ");
    while (!section.empty()) {
      const std::string_view line = take_until("\n", section);
      if (line.starts_with(".It ")) listed.emplace(line.substr(4));
    }
    EXPECT_EQ(listed, declared) << page_of(command);
  }
}

TEST_F(PageTest, OfTheProgramHasItsCommandsAndSchemas) {
  const std::string page = read_page("cbc.1");
  std::set<std::string> commands;
  for (const Command& command : program_.commands()) commands.insert(command.name());
  EXPECT_EQ(items(subsection(page, "Commands"), "Cm"), commands);
  std::set<std::string> schemas;
  for (const cli::NameWithHelp& schema : program_.find("schema")->find("NAME")->values.names()) {
    schemas.insert(schema.name);
  }
  EXPECT_EQ(items(between(page, ".Sh SCHEMAS", ".Sh "), "Ic"), schemas);
}

TEST_F(PageTest, MentionsNoUnknownOption) {
  std::set<std::string> known;
  for (const Option& option : program_.itself().options()) {
    known.insert(option.names.begin(), option.names.end());
  }
  for (const Command& command : program_.commands()) {
    for (const Option& option : command.options()) {
      known.insert(option.names.begin(), option.names.end());
    }
  }
  const std::regex option(R"(\bFl (-?[\w-]+))");
  for (const auto& file : std::filesystem::directory_iterator(CBC_SOURCE_DIR "/man")) {
    const std::string name = file.path().filename().string();
    const std::string page = read_page(name);
    for (std::sregex_iterator found(page.begin(), page.end(), option), end; found != end; ++found) {
      EXPECT_TRUE(known.contains('-' + found->str(1))) << name << ": " << found->str();
    }
  }
}

}  // namespace
}  // namespace cbc::manual::options_test
