#include "core/check/allow_comments.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/diagnostic/rules.h"
#include "findings.h"
#include "support/rounds.h"

namespace cbc::allow_comments_test {
namespace {

/// A finding of a rule, dead-task unless it says otherwise, at the beginning of a line.
struct At {
  std::uint32_t line = 1;
  std::string_view of = rule::dead_task;
};

std::vector<Diagnostic> findings_at(const std::vector<At>& places) {
  std::vector<Diagnostic> findings;
  for (const At& place : places) {
    const Range range{{place.line, 1}, {place.line, 2}};
    findings.push_back({place.of, Severity::warning, "a.yaml", range, "found", {}});
  }
  return findings;
}

std::string show(const std::vector<Diagnostic>& findings) {
  Diagnostics diagnostics;
  for (const Diagnostic& finding : findings) diagnostics.add(finding);
  return show(diagnostics);
}

std::vector<Diagnostic> apply_to(std::string_view text, std::vector<Diagnostic> findings,
                                 bool is_complete = true) {
  Diagnostics ignored;
  const std::unique_ptr<const yaml::Document> document = yaml::parse(text, "a.yaml", ignored);
  return apply_allow_comments(std::move(findings), {"a.yaml", text, document.get(), is_complete});
}

/// What is left of findings in a text that must be valid YAML, and what is added.
std::string control(std::string_view text, const std::vector<At>& places = {},
                    bool is_complete = true) {
  Diagnostics errors;
  EXPECT_NE(yaml::parse(text, "a.yaml", errors), nullptr) << show(errors);
  return show(apply_to(text, findings_at(places), is_complete));
}

/// The lines, of those up to `last`, on which a finding is allowed by the comments of a text.
std::string allowed_lines(std::string_view text, std::uint32_t last) {
  Diagnostics errors;
  EXPECT_NE(yaml::parse(text, "a.yaml", errors), nullptr) << show(errors);
  std::string lines;
  for (std::uint32_t line = 1; line <= last; ++line) {
    const std::vector<Diagnostic> left = apply_to(text, findings_at({{line}}), false);
    if (left.empty()) lines += std::to_string(line) + " ";
  }
  return lines;
}

constexpr std::string_view unneeded = "no finding of rule 'dead-task' needs this comment\n";

TEST(AllowComments, OnlyTheNamedRulesAreAllowed) {
  EXPECT_EQ(control("a: 1  # cbc: allow dead-task, dead-behavior\n",
                    {{1}, {1, rule::dead_behavior}, {1, rule::unknown_key}}),
            "1:1-2 warning unknown-key: found\n");
}

TEST(AllowComments, ADashBeginsAnItemIfABlankOrTheEndOfTheLineFollows) {
  EXPECT_EQ(allowed_lines("# cbc: allow dead-task\na: 1\n-b: 1\n", 3), "1 2 ");
  EXPECT_EQ(allowed_lines("# cbc: allow dead-task\na:\n-\n  b\n-\nc:\n", 6), "1 2 3 4 5 ");
}

TEST(AllowComments, AtTheEndOfTheFileNothingFollows) {
  EXPECT_EQ(control("a: 1\n# cbc: allow dead-task", {{1}}),
            "1:1-2 warning dead-task: found\n"
            "2:14-23 warning unused-allow: " +
                std::string(unneeded));
  EXPECT_EQ(control("# cbc: allow dead-task\n\n# end\n"),
            "1:14-23 warning unused-allow: " + std::string(unneeded));
  EXPECT_EQ(control("a: 1 # cbc: allow dead-task", {{1}}), "");
}

TEST(AllowComments, UnderstandsOtherSpellings) {
  for (const std::string comment :
       {"#cbc:allow dead-task", "#  cbc:  allow  dead-task , dead-behavior",
        "#\tcbc:\tallow\tdead-task", "# cbc: allow dead-task -- because, and why not: allow",
        "# cbc: allow dead-task --because", "# cbc: allow dead-task,",
        "# cbc: allow ,,dead-task,, dead-behavior  "}) {
    EXPECT_EQ(show(apply_to("a: 1 " + comment + "\n", findings_at({{1}}), false)), "") << comment;
  }
}

TEST(AllowComments, OtherCommentsSayNothing) {
  for (const std::string comment :
       {"## cbc: allow dead-task", "# CBC: allow dead-task", "# cbc allow dead-task",
        "# see cbc: allow dead-task", "# cbc : allow dead-task", "#", "# ",
        "# xcbc: allow dead-task"}) {
    EXPECT_EQ(control("a: 1 " + comment + "\n", {{1}}), "1:1-2 warning dead-task: found\n")
        << comment;
  }
}

TEST(AllowComments, ReportsWhatIsNotUnderstood) {
  EXPECT_EQ(control("a: 1 # cbc: alow dead-task\n"),
            "1:13-17 warning unknown-rule: expected 'allow' after 'cbc:', found 'alow'; did you "
            "mean 'allow'?\n");
  EXPECT_EQ(control("a: 1 # cbc: Allow dead-task\n"),
            "1:13-18 warning unknown-rule: expected 'allow' after 'cbc:', found 'Allow'; did you "
            "mean 'allow'?\n");
  EXPECT_EQ(control("a: 1 # cbc: ignore dead-task, dead-behavior\n"),
            "1:13-19 warning unknown-rule: expected 'allow' after 'cbc:', found 'ignore'\n");
  EXPECT_EQ(control("a: 1 # cbc:\n"),
            "1:6-12 warning unknown-rule: the comment is empty: expected 'cbc: allow RULE'\n");
  for (const std::string comment : {"# cbc: allow", "# cbc: allow  ", "# cbc: allow ,",
                                    "# cbc: allow -- dead-task", "# cbc: allow\t"}) {
    const std::string report = control("a: 1 " + comment + "\n");
    EXPECT_EQ(report.substr(0, 4), "1:6-") << report;
    EXPECT_NE(report.find("warning unknown-rule: the comment names no rule: expected 'cbc: allow "
                          "RULE'\n"),
              std::string::npos)
        << report;
  }
}

TEST(AllowComments, ReportsUnknownRulesWithTheNearest) {
  EXPECT_EQ(control("é: 1 # cbc: allow ded-task, dead-task, nothing-like-it\n", {{1}}),
            "1:19-27 warning unknown-rule: there is no rule 'ded-task'; did you mean 'dead-task'?\n"
            "1:40-55 warning unknown-rule: there is no rule 'nothing-like-it'\n");
  // One finding for one fault.
  EXPECT_EQ(control("a: 1 # cbc: allow dead-task: for a reason, or two\n"),
            "1:19-29 warning unknown-rule: there is no rule 'dead-task:'; did you mean "
            "'dead-task'?\n");
  EXPECT_EQ(control("a: 1 # cbc: allow dead-task because, as I said\n", {{1}}),
            "1:29-36 warning unknown-rule: expected ',' and another rule, or '-- ' and a reason, "
            "found 'because'\n");
}

TEST(AllowComments, OfSeveralTheInnermostIsUsed) {
  EXPECT_EQ(control("# cbc: allow dead-task\na:\n  # cbc: allow dead-task\n  b: 1\n", {{4}}),
            "1:14-23 warning unused-allow: " + std::string(unneeded));
  EXPECT_EQ(control("# cbc: allow dead-task\na:\n  # cbc: allow dead-task\n  b: 1\n", {{2}, {4}}),
            "");
  EXPECT_EQ(control("a: 1 # cbc: allow dead-task, dead-task\n", {{1}, {1}}),
            "1:19-28 warning unused-allow: " + std::string(unneeded));
}

TEST(AllowComments, UndecidedAllowsAreNotCalledUnused) {
  EXPECT_EQ(control("a: 1 # cbc: allow dead-task, unused-allow\n", {}, false), "");
  // What is certain is still reported.
  EXPECT_EQ(control("a: 1 # cbc: allow dead-tasks, missing-key\n", {}, false),
            "1:19-29 warning unknown-rule: there is no rule 'dead-tasks'; did you mean "
            "'dead-task'?\n"
            "1:31-42 warning unused-allow: 'missing-key' is always an error: a file that breaks "
            "this rule has no meaning\n");
}

TEST(AllowComments, FixedRulesStay) {
  EXPECT_EQ(control("a: 1 # cbc: allow missing-key\n", {{1, rule::missing_key}}),
            "1:1-2 warning missing-key: found\n"
            "1:19-30 warning unused-allow: 'missing-key' is always an error: a file that breaks "
            "this rule has no meaning\n");
  for (const Rule& rule : all_rules()) {
    const std::string text = "a: 1 # cbc: allow " + std::string(rule.name) + "\n";
    const std::vector<Diagnostic> left = apply_to(text, findings_at({{1, rule.name}}));
    EXPECT_EQ(left.size(), rule.is_fixed ? 2U : 0U) << rule.name;
  }
}

TEST(AllowComments, FindingsAboutCommentsCannotBeAllowed) {
  EXPECT_EQ(control("a: 1 # cbc: allow unused-allow\n"),
            "1:19-31 warning unused-allow: no finding of rule 'unused-allow' needs this comment\n");
  EXPECT_EQ(control("# cbc: allow unknown-rule\na: 1 # cbc: allow no-rule\n"),
            "1:14-26 warning unused-allow: no finding of rule 'unknown-rule' needs this comment\n"
            "2:19-26 warning unknown-rule: there is no rule 'no-rule'\n");
}

TEST(AllowComments, TextsAreNoComments) {
  for (const std::string text : {
           "a: \"x # cbc: alow\"\n",
           "a: 'x # cbc: alow'\n",
           "a: 'it''s # cbc: alow'\n",
           "a: \"\\\" # cbc: alow\"\n",
           "a: \"\\\\\" \nb: ' # cbc: alow'\n",
           "\"# cbc: alow\": 1\n",
           "a: ['# cbc: alow', \" # cbc: alow\", {b: ' # cbc: alow'}]\n",
           "a: \"x\n  # cbc: alow\n  y\"\n",
           "a: 'x\n\n  # cbc: alow'\n",
           "a: x# cbc:alow\n",
           "a: b#cbc:alow\n",
           "a: !!str \" # cbc: alow\"\n",
           "a: &b ' # cbc: alow'\nc: *b\n",
           "a: 1\n<<: {a: ' # cbc: alow'}\n",
           "' # cbc: alow'",
       }) {
    EXPECT_EQ(control(text), "") << text;
  }
}

TEST(AllowComments, CommentsAfterTextsAreComments) {
  for (const std::string before :
       {"a: \"x # cbc: no\" ", "a: 'x' ", "a: it's ", "a: don't say \"no ", "a: 'it''s' ",
        R"(a: "\\" )", "a: ['#', \"#\", x#y] ", "a: \"x\n  # cbc: no\n  y\" ", "a: \"é # ü\" ",
        "a: x\n  \"y ", "a: 1 ", "- "}) {
    const auto line =
        static_cast<std::uint32_t>(1 + std::count(before.begin(), before.end(), '\n'));
    EXPECT_EQ(control(before + "# cbc: allow dead-task\n", {{line}}), "") << before;
  }
}

TEST(AllowComments, LinesOfBlockScalarsAreNoComments) {
  for (const std::string header :
       {"|", ">", "|-", ">+", "|2", ">2-", "| # word", "!!str |", "&x >"}) {
    for (const std::string lead : {"", "\n", "      \n", "    more\n", "\n    more\n"}) {
      // If the text does not give its indentation, its first line does.
      if (lead.size() > 1 && header.find('2') == std::string::npos) continue;
      std::string text = "a: ";
      text.append(header).append("\n").append(lead).append(
          "  word\n  # cbc: alow\n\n    # cbc: alow\n   \n"
          "# cbc: allow dead-task\n  # cbc: allow dead-behavior\nb: 1\n");
      const auto line = static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n'));
      EXPECT_EQ(control(text, {{line}, {line, rule::dead_behavior}}), "") << text;
    }
  }
}

TEST(AllowComments, CommentsAroundBlockScalarsAreComments) {
  EXPECT_EQ(control("a: | # cbc: allow dead-task\n  # cbc: alow\nb: 1\n", {{1}}), "");
  EXPECT_EQ(control("- |\n # cbc: alow\n- > # cbc: allow dead-task\n  # cbc: alow\n", {{3}}), "");
  // The text is empty, so the comment is one.
  EXPECT_EQ(control("a: |\n# cbc: allow dead-task\nb: 1\n", {{3}}), "");
  EXPECT_EQ(control("a: |\n\n# cbc: allow dead-task\nb: 1\n", {{4}}), "");
  // The text belongs to the entry.
  EXPECT_EQ(allowed_lines("# cbc: allow dead-task\na: |\n  - b\n\n   # c\n  d: 1\ne: 1\n", 7),
            "1 2 3 4 5 6 ");
  EXPECT_EQ(
      allowed_lines("a:\n  # cbc: allow dead-task\n  - b: |\n      x\n\n      y\n  - c: 1\n", 7),
      "2 3 4 5 6 ");
  EXPECT_EQ(control("--- |\n  # cbc: alow\n"), "");
}

TEST(AllowComments, TextsOverSeveralLinesDoNotEndAnEntry) {
  EXPECT_EQ(
      allowed_lines("# cbc: allow dead-task\na:\n  b: \"x\n\n  - y\n  z: 1\"\n  c: 1\nd: 1\n", 8),
      "1 2 3 4 5 6 7 ");
}

TEST(AllowComments, UnderstandsFlowStyle) {
  const std::string_view text =
      "{\n"                                              // 1
      "  \"tasks\": [\n"                                 // 2
      "    # cbc: allow dead-task\n"                     // 3
      "    {\n"                                          // 4
      "      \"task\": \"# A\"\n"                        // 5
      "    },\n"                                         // 6
      "    {\"task\": \"B\"}, # cbc: allow dead-task\n"  // 7
      "    # cbc: allow dead-task\n"                     // 8
      "    {\"task\": \"C\",\n"                          // 9
      "     \"timeout\": 3}\n"                           // 10
      "  ]\n"                                            // 11
      "}\n";                                             // 12
  EXPECT_EQ(allowed_lines(text, 12), "3 4 5 7 8 9 10 ");
  EXPECT_EQ(allowed_lines(
                "a: [x, # cbc: allow dead-task\n  y,\n  # cbc: allow dead-task\n  z,\n  w]\n", 5),
            "1 3 4 ");
  EXPECT_EQ(allowed_lines("- {a: 1, b: [2]} # cbc: allow dead-task\n- {a: 1}\n", 2), "1 ");
}

TEST(AllowComments, UnderstandsLineEndingsAndByteOrderMarks) {
  const std::string text =
      "# cbc: allow dead-task\na:\n  b: \"#\n  c\" # cbc: allow dead-behavior\nc: |\n  # cbc: "
      "alow\n"
      "# cbc: allow\nd: 1";
  std::string other = "\xEF\xBB\xBF";
  for (const char byte : text) other += byte == '\n' ? std::string("\r\n") : std::string(1, byte);
  const std::vector<At> places = {{2}, {4, rule::dead_behavior}, {8}};
  EXPECT_EQ(control(text, places),
            "7:1-13 warning unknown-rule: the comment names no rule: expected 'cbc: allow RULE'\n"
            "8:1-2 warning dead-task: found\n");
  EXPECT_EQ(control(other, places), control(text, places));
  EXPECT_EQ(control("\xEF\xBB\xBF# cbc: alow\na: 1\n"), control("# cbc: alow\na: 1\n"));
  EXPECT_EQ(control("a: 1 # cbc: allow dead-task\r\n", {{1}}), "");
}

TEST(AllowComments, TextsThatAreNoYamlHaveCommentsToo) {
  EXPECT_EQ(show(apply_to("# cbc: allow dead-task, no-rule\na: [\n", findings_at({{2}}), false)),
            "1:25-32 warning unknown-rule: there is no rule 'no-rule'\n");
  for (const std::string text :
       {"\xFF # cbc: allow x", "\xFF\xFE#\0c", "#", "# cbc:", "\n\n#cbc:allow",
        "a: 'x # cbc: allow dead-task", "\t# cbc: allow dead-task\n\tx: 1", "- - - # cbc: allow --",
        "\r\r\r#cbc:\r", "cbc:", "[[[[\n# cbc: allow x\n}"}) {
    const std::vector<Diagnostic> left = apply_to(text, findings_at({{1}, {99}}), false);
    EXPECT_LE(left.size(), 3U) << text;
  }
}

TEST(AllowComments, AllTextsCutAnywhereAreRead) {
  const std::string text =
      "\xEF\xBB\xBF# cbc: allow dead-task -- é\r\na: |2\n   # cbc: alow\n- b: 'it''s # x' # cbc: "
      "allow x\n"
      "  \"c\n  d\": {e: [1, # cbc: allow unused-allow\n 2]}\n";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    const std::vector<Diagnostic> left = apply_to(text.substr(0, size), findings_at({{3}}));
    EXPECT_LE(left.size(), 6U) << size;
  }
}

TEST(AllowComments, TakesLinearTime) {
  constexpr std::uint32_t count = 30'000;
  // One entry with many comments, in it many findings, each with a comment; one line with many
  // names; texts with many '#' in one line.
  std::string text;
  for (std::uint32_t i = 0; i < count; ++i) text += "# cbc: allow dead-task\n";
  text += "tasks:\n";
  std::vector<At> places;
  for (std::uint32_t i = 0; i < count; ++i) {
    text += "  # cbc: allow dead-behavior\n  - a\n";
    places.push_back({count + 3 + 2 * i});
    places.push_back({count + 3 + 2 * i, rule::dead_behavior});
  }
  text += "  - [";
  for (std::uint32_t i = 0; i < count; ++i) text += "' # cbc: alow', ";
  text += "]\n  - x # cbc: allow unknown-key";
  for (std::uint32_t i = 0; i < count; ++i) text += ",deadtask";
  const std::vector<Diagnostic> left = apply_to(text, findings_at(places));
  // Of the comments in a row, the last one is used; of the last line nothing is.
  EXPECT_EQ(left.size(), std::size_t{count - 1} + 1 + count);
}

// Random files --------------------------------------------------------------------------------

struct RandomFile {
  std::vector<std::string> lines;
  std::vector<At> places;

  [[nodiscard]] std::string text() const {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
  }
};

constexpr std::string_view comment_text = "# cbc: allow dead-task";

class FileWriter {
 public:
  explicit FileWriter(std::uint32_t seed) : random_(seed) {}

  RandomFile write() {
    write_mapping("", "", 3);
    if (chance(3)) add_comment("");
    return std::move(file_);
  }

 private:
  int below(int limit) { return static_cast<int>(random_() % static_cast<std::uint32_t>(limit)); }

  bool chance(int of) { return below(of) == 0; }

  void add_comment(const std::string& indentation) {
    file_.lines.push_back(indentation + (chance(3) ? "# other" : std::string(comment_text)));
  }

  void add_between(const std::string& indentation) {
    while (chance(3)) {
      if (chance(3)) {
        file_.lines.emplace_back();
      } else {
        add_comment(chance(3) ? "" : indentation);
      }
    }
  }

  void add_content(std::string line) {
    if (chance(5)) line += "  " + std::string(comment_text);
    file_.lines.push_back(std::move(line));
    if (chance(3)) file_.places.push_back({static_cast<std::uint32_t>(file_.lines.size())});
  }

  // The first key stands after `first`, the others after `indentation`.
  void write_mapping(const std::string& first, const std::string& indentation, int height) {
    const int keys = 1 + below(3);
    for (int key = 0; key < keys; ++key) {
      if (key > 0 || first.empty()) add_between(indentation);
      const std::string name = (key == 0 ? first : indentation) + "k" + std::to_string(key) + ":";
      if (height == 0 || chance(3)) {
        add_content(name + (chance(3) ? " '# cbc: allow dead-task'" : " 1"));
      } else if (chance(2)) {
        add_content(name);
        write_mapping(indentation + "  ", indentation + "  ", height - 1);
      } else {
        add_content(name);
        write_list(indentation + (chance(2) ? "  " : ""), height - 1);
      }
    }
  }

  void write_list(const std::string& indentation, int height) {
    const int items = 1 + below(3);
    for (int item = 0; item < items; ++item) {
      add_between(indentation);
      if (chance(3)) {
        add_content(indentation + "- x");
      } else {
        write_mapping(indentation + "- ", indentation + "  ", height > 0 ? height - 1 : 0);
      }
    }
  }

  std::mt19937 random_;
  RandomFile file_;
};

std::size_t indentation_of(const std::string& line) { return line.find_first_not_of(' '); }

bool is_item(const std::string& line) { return line[indentation_of(line)] == '-'; }

bool is_empty_or_comment(const std::string& line) {
  return line.empty() || line[indentation_of(line)] == '#';
}

// Straight from the description: which lines the comment of a line is about.
std::vector<bool> lines_of_comment(const std::vector<std::string>& lines, std::size_t at) {
  std::vector<bool> about(lines.size(), false);
  if (!is_empty_or_comment(lines[at])) {
    about[at] = true;
    return about;
  }
  std::size_t entry = at + 1;
  while (entry < lines.size() && is_empty_or_comment(lines[entry])) ++entry;
  if (entry == lines.size()) return about;
  about[entry] = true;
  for (std::size_t line = entry + 1; line < lines.size(); ++line) {
    if (is_empty_or_comment(lines[line])) continue;
    const bool is_deeper = indentation_of(lines[line]) > indentation_of(lines[entry]);
    const bool is_own_item = !is_item(lines[entry]) && is_item(lines[line]) &&
                             indentation_of(lines[line]) == indentation_of(lines[entry]);
    if (!is_deeper && !is_own_item) break;
    about[line] = true;
  }
  return about;
}

TEST(AllowComments, RandomFilesAgreeWithTheDescription) {
  std::size_t allowed = 0;
  std::size_t kept = 0;
  std::size_t unused = 0;
  for (std::uint32_t seed = 0; seed < test::rounds(3000U); ++seed) {
    const RandomFile file = FileWriter(seed).write();
    const std::size_t none = file.lines.size();
    std::vector<std::size_t> allowed_by(file.lines.size(), none);
    std::set<std::size_t> comments;
    for (std::size_t at = 0; at < file.lines.size(); ++at) {
      if (!file.lines[at].ends_with(comment_text)) continue;
      comments.insert(at);
      const std::vector<bool> about = lines_of_comment(file.lines, at);
      for (std::size_t line = 0; line < about.size(); ++line) {
        if (about[line]) allowed_by[line] = at;
      }
    }
    Diagnostics expected;
    for (const Diagnostic& finding : findings_at(file.places)) {
      const std::size_t by = allowed_by[finding.range.begin.line - 1];
      if (by == none) expected.add(finding);
      comments.erase(by);
      ++(by == none ? kept : allowed);
    }
    ASSERT_EQ(control(file.text(), file.places, false), show(expected)) << "seed " << seed << "\n"
                                                                        << file.text();
    for (const std::size_t at : comments) {
      const auto end = static_cast<std::uint32_t>(file.lines[at].size() + 1);
      const auto line = static_cast<std::uint32_t>(at + 1);
      const auto begin = static_cast<std::uint32_t>(end - rule::dead_task.name.size());
      expected.add({rule::unused_allow,
                    Severity::warning,
                    "a.yaml",
                    {{line, begin}, {line, end}},
                    "no finding of rule 'dead-task' needs this comment",
                    {}});
      ++unused;
    }
    ASSERT_EQ(control(file.text(), file.places), show(expected)) << "seed " << seed << "\n"
                                                                 << file.text();
  }
  EXPECT_GT(allowed, test::rounds(1000U));
  EXPECT_GT(kept, test::rounds(1000U));
  EXPECT_GT(unused, test::rounds(1000U));
}

// Comments and settings together --------------------------------------------------------------

TEST(Controls, SettingsComeAfterComments) {
  constexpr std::string_view text = "a: 1 # cbc: allow dead-task, no-rule, dead-behavior\n";
  Diagnostics errors;
  const auto document = yaml::parse(text, "a.yaml", errors);
  SeveritySettings settings;
  settings.set(*find_rule(rule::dead_task), RuleSetting::error);
  settings.set(*find_rule(rule::unknown_rule), RuleSetting::error);
  settings.set(*find_rule(rule::unused_allow), RuleSetting::allow);
  settings.set(*find_rule(rule::unknown_key), RuleSetting::allow);
  EXPECT_EQ(show(control_findings(findings_at({{2}, {1}, {2, rule::unknown_key}}),
                                  {"a.yaml", text, document.get(), true}, settings)),
            "1:30-37 error unknown-rule: there is no rule 'no-rule'\n"
            "2:1-2 error dead-task: found\n");
}

TEST(Controls, AnAllowOfARuleThatIsSilencedIsUsed) {
  constexpr std::string_view text = "a: 1 # cbc: allow dead-task\n";
  SeveritySettings settings;
  settings.set(*find_rule(rule::dead_task), RuleSetting::allow);
  EXPECT_EQ(show(control_findings(findings_at({{1}}), {"a.yaml", text, nullptr, true}, settings)),
            "");
}

TEST(Controls, PastTheNodeLimitNoAllowIsCalledUnused) {
  constexpr std::string_view text = "a: 1 # cbc: allow dead-task\n";
  const CommentedFile file{"a.yaml", text, nullptr, true};
  EXPECT_EQ(control_findings(findings_at({{1, rule::undecided}}), file, {}).size(), 1U);
  EXPECT_EQ(control_findings(findings_at({{1, rule::unknown_key}}), file, {}).size(), 2U);
}

}  // namespace
}  // namespace cbc::allow_comments_test
