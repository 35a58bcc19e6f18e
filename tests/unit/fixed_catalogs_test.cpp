#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/catalog.h"
#include "core/check/check.h"
#include "core/diagnostic/rules.h"
#include "support/catalog_files.h"
#include "support/read_file.h"
#include "support/rounds.h"
#include "support/shared_folder.h"
#include "unit/findings.h"

// Whole catalogs, mended: published ones, if they are at hand, and random ones.

namespace cbc::fixed_catalogs_test {
namespace {

struct Linted {
  CatalogReading reading;
  std::vector<Diagnostic> findings;
};

Linted lint(const std::string& text) {
  Linted linted;
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "a.yaml", diagnostics);
  if (document != nullptr) linted.reading = lint_catalog(*document, {}, diagnostics).reading;
  diagnostics.sort();
  linted.findings = diagnostics.release();
  return linted;
}

std::size_t count(const Linted& linted, std::string_view rule) {
  return static_cast<std::size_t>(
      std::count_if(linted.findings.begin(), linted.findings.end(),
                    [rule](const Diagnostic& finding) { return finding.rule == rule; }));
}

std::size_t count_errors(const Linted& linted) {
  return static_cast<std::size_t>(
      std::count_if(linted.findings.begin(), linted.findings.end(),
                    [](const Diagnostic& finding) { return finding.severity == Severity::error; }));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// What one line must be like with present names, told by its words alone.
std::string modern(std::string line) {
  const std::size_t content = line.find_first_not_of(" -");
  const std::size_t colon = line.find(": ");
  if (content == std::string::npos || colon == std::string::npos || line[content] == '#') {
    return line;
  }
  const std::string key = line.substr(content, colon - content);
  std::string value = line.substr(colon + 2);
  std::string name = key;
  if (key == "efficacy") name = "suitability";
  if (key == "default") name = "reactive_start";
  if (key == "automatic_activation") {
    name = "start_on_request";
    value.replace(0, value.find_first_of(" \r"), value[0] == 'T' ? "FALSE" : "TRUE");
  }
  if (key == "category") {
    name = "execution_goal";
    value.replace(0, value.find_first_of(" \r"), value[0] == 'g' ? "achieve_goal" : "keep_running");
  }
  return line.substr(0, content) + name + ": " + value;
}

void expect_mended(const std::string& text) {
  const Linted before = lint(text);
  const FixedText fixed = apply_fixes(text, before.findings);
  const Linted after = lint(fixed.text);
  EXPECT_EQ(count(after, rule::deprecated_key), 0U);
  EXPECT_EQ(count_errors(after), count_errors(before));
  EXPECT_EQ(after.reading.is_complete, before.reading.is_complete);
  EXPECT_TRUE(same_meaning(before.reading.catalog, after.reading.catalog));
  EXPECT_EQ(after.findings.size() + fixed.mended.size(), before.findings.size());
  EXPECT_EQ(apply_fixes(fixed.text, after.findings).text, fixed.text);

  // The lines that are left are in order, and those of removed entries are no comments.
  const std::vector<std::string> new_lines = lines_of(fixed.text);
  std::size_t kept = 0;
  for (const std::string& line : lines_of(text)) {
    if (kept < new_lines.size() && new_lines[kept] == modern(line)) {
      ++kept;
    } else {
      EXPECT_EQ(line.find('#'), std::string::npos) << line;
    }
  }
  EXPECT_EQ(kept, new_lines.size());
  if (fixed.mended.empty()) {
    EXPECT_EQ(fixed.text, text);
  }
}

/// The same text with other line breaks.
std::string with_carriage_returns(const std::string& text) {
  std::string result;
  for (const char byte : text) result += byte == '\n' ? "\r\n" : std::string(1, byte);
  return result;
}

void expect_mended_in(const std::filesystem::path& folder) {
  for (const auto& file : test::catalog_files(folder)) {
    SCOPED_TRACE(file.string());
    const std::string text = test::read_file(file);
    expect_mended(text);
    expect_mended(with_carriage_returns(text));
    expect_mended("\xEF\xBB\xBF" + text.substr(0, text.find_last_not_of('\n') + 1));
  }
}

TEST(FixedCatalogs, OwnOnes) {
  const std::filesystem::path folder(CBC_SOURCE_DIR "/catalogs");
  ASSERT_FALSE(test::catalog_files(folder).empty());
  expect_mended_in(folder);
}

TEST(FixedCatalogs, PublishedOnes) {
  const std::filesystem::path folder = test::shared_catalogs();
  if (test::catalog_files(folder).empty()) GTEST_SKIP() << "no catalogs in " << folder;
  expect_mended_in(folder);
}

/// Writes a random catalog twice, with the older keys and with the present ones. What is random
/// comes from the seed alone, so that the two differ in nothing else.
class Writer {
 public:
  Writer(unsigned seed, bool older) : random_(seed), older_(older) {}

  std::string catalog() {
    if (chance(4)) text_ = "\xEF\xBB\xBF";
    json_ = chance(5);
    quoted_ = json_ || chance(4);
    flow_ = json_ || chance(3);
    comment();
    const std::size_t tasks = 1 + random_() % 6;
    if (json_) text_ += "{ ";
    section("default_values", [&] { defaults(); });
    if (json_) text_ += ",\n";
    section("tasks", [&] { write_tasks(tasks); });
    if (json_) text_ += ",\n";
    section("behaviors", [&] { write_behaviors(tasks); });
    if (json_) text_ += " }\n";
    if (chance(3)) text_.pop_back();
    return chance(3) ? with_carriage_returns(text_) : text_;
  }

 private:
  bool chance(unsigned one_in) { return random_() % one_in == 0; }

  void comment() {
    if (!json_ && chance(3)) text_ += "# default: é category: recurrent\n";
  }

  std::string quote(const std::string& word) {
    if (json_) return "\"" + word + "\"";
    if (!quoted_ || chance(2)) return word;
    return chance(2) ? "'" + word + "'" : "\"" + word + "\"";
  }

  template <typename Body>
  void section(const std::string& name, Body body) {
    comment();
    text_ += (json_ ? quote(name) : name) + ":" + (flow_ ? " " : "\n");
    body();
    if (!json_ && flow_) text_ += "\n";
  }

  using Entry = std::vector<std::string>;  // "key: value"

  void write(const std::vector<Entry>& entries) {
    if (flow_) text_ += "[";
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (flow_) {
        if (i > 0) text_ += chance(2) ? ", " : ",\n  ";
        text_ += "{";
      } else {
        comment();
      }
      for (std::size_t j = 0; j < entries[i].size(); ++j) {
        if (flow_) {
          text_ += (j > 0 ? ", " : "") + entries[i][j];
        } else {
          text_ += (j > 0 ? "  " : "- ") + entries[i][j] + (chance(4) ? "  # TRUE" : "") + "\n";
        }
      }
      if (flow_) text_ += "}";
    }
    if (flow_) text_ += "]";
  }

  std::string field(const std::string& key, const std::string& value) {
    return quote(key) + ": " + std::string(json_ ? 0 : random_() % 3, ' ') + value;
  }

  std::string renamed(const std::string& old_key, const std::string& new_key,
                      const std::string& old_value, const std::string& new_value) {
    return older_ ? field(old_key, old_value) : field(new_key, new_value);
  }

  std::string category(const std::string& old_word, const std::string& new_word) {
    const std::string value = quote(older_ ? old_word : new_word);
    return renamed("category", "execution_goal", value, value);
  }

  std::string percent() { return std::to_string(random_() % 101); }

  std::string suitability() {
    const std::string value = percent();
    return renamed("efficacy", "suitability", value, value);
  }

  void add_attributes(Entry& entry) {
    using Pair = std::pair<const char*, const char*>;
    constexpr std::array<Pair, 11> booleans{
        Pair{"true", "false"}, {"True", "False"}, {"TRUE", "FALSE"}, {"yes", "no"},
        {"Yes", "No"},         {"YES", "NO"},     {"on", "off"},     {"On", "Off"},
        {"ON", "OFF"},         {"y", "n"},        {"Y", "N"}};
    const auto& [yes, no] = booleans[json_ ? 0 : random_() % booleans.size()];
    if (chance(2)) {
      entry.push_back(chance(2) ? category("goal_based", "achieve_goal")
                                : category("recurrent", "keep_running"));
    }
    // Never both of them.
    const bool reactive = chance(2);
    if (chance(2)) {
      entry.push_back(reactive ? renamed("automatic_activation", "start_on_request", yes, no)
                               : renamed("automatic_activation", "start_on_request", no, yes));
    }
    if (chance(2)) {
      const char* const value = reactive ? yes : no;
      entry.push_back(renamed("default", "reactive_start", value, value));
    }
    if (chance(4)) entry.push_back(field("timeout", std::to_string(1 + random_() % 99)));
    std::shuffle(entry.begin(), entry.end(), Shuffler{random_});
  }

  // Takes a number of the generator whatever the standard library does.
  struct Shuffler {
    using result_type = std::mt19937::result_type;
    static constexpr result_type min() { return std::mt19937::min(); }
    static constexpr result_type max() { return std::mt19937::max(); }
    result_type operator()() { return random(); }
    std::mt19937& random;
  };

  void defaults() {
    Entry tasks;
    if (chance(2)) tasks.push_back(field("timeout", "15"));
    if (chance(2)) {
      tasks.push_back(category("recurrent", "keep_running"));
    }
    tasks.push_back(renamed("default", "reactive_start", "false", "false"));
    std::string joined;
    for (const std::string& entry : tasks) joined += (joined.empty() ? "" : ", ") + entry;
    const std::string behaviors = suitability();
    write({{(json_ ? quote("tasks") : std::string("tasks")) + ": {" + joined + "}"},
           {(json_ ? quote("behaviors") : std::string("behaviors")) + ": {" + behaviors + "}"}});
  }

  void write_tasks(std::size_t tasks) {
    std::vector<Entry> entries;
    for (std::size_t task = 0; task < tasks; ++task) {
      Entry entry{field("task", quote("T" + std::to_string(task)))};
      add_attributes(entry);
      entries.push_back(entry);
    }
    write(entries);
  }

  void write_behaviors(std::size_t tasks) {
    std::vector<Entry> entries;
    for (std::size_t behavior = 0; behavior < tasks; ++behavior) {
      Entry entry{field("behavior", quote("efficacy " + std::to_string(behavior) + " é日"))};
      const std::string task = quote("T" + std::to_string(behavior));
      if (chance(3)) {
        std::string list = "[{" + field("task", task);
        if (chance(2)) list += ", " + suitability();
        entry.push_back(field("tasks", list + "}]"));
      } else {
        entry.push_back(field("task", task));
      }
      if (chance(2)) entry.push_back(suitability());
      entries.push_back(entry);
    }
    write(entries);
  }

  std::mt19937 random_;
  bool older_;
  bool json_ = false;
  bool quoted_ = false;
  bool flow_ = false;
  std::string text_;
};

TEST(FixedCatalogs, RandomOnesAreAsIfWrittenWithPresentKeys) {
  std::size_t mended = 0;
  for (unsigned seed = 1; seed <= test::rounds(1'000U); ++seed) {
    SCOPED_TRACE(seed);
    const std::string older = Writer(seed, true).catalog();
    const Linted before = lint(older);
    ASSERT_TRUE(before.reading.is_complete) << older;
    const FixedText fixed = apply_fixes(older, before.findings);
    ASSERT_EQ(fixed.text, Writer(seed, false).catalog());
    const Linted after = lint(fixed.text);
    EXPECT_EQ(count(after, rule::deprecated_key), 0U);
    EXPECT_TRUE(same_meaning(before.reading.catalog, after.reading.catalog)) << older;
    EXPECT_EQ(apply_fixes(fixed.text, after.findings).text, fixed.text);
    mended += fixed.mended.size();
  }
  EXPECT_GT(mended, test::rounds(5'000U));
}

/// Catalogs with much to mend, damaged at random: pieces are put in, taken out and doubled.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string catalog() {
    static const std::array<std::string, 2> samples{R"(tasks:
- task: A
  category: recurrent
- task: B   # second
- task: A
  category: recurrent

- automatic_activation: TRUE
  task: C
  parameters:
  - parameter: p
    allowed_values: [1, 2]
  - parameter: p
    allowed_values: [1, 2]
- task: C
  start_on_request: FALSE
behaviors:
- {behavior: a, task: A, efficacy: 3}
- behavior: b
  task: B
  efficacy: 4
- behavior: c
  tasks: [{task: C, efficacy: 20}]
exclusivity_constraints:
- mutually_exclusive: [A, B, A]
- mutually_exclusive:
  - B
  - A
  - B
- mutually_exclusive: [A, B, C]
)",
                                                    R"({"tasks": [
  {"task": "A"}, {"task": "B", "default": false},
  {"task": "A", "timeout": null},
  {"task": "B"}, {task: C, parameters: [{parameter: p}, {parameter: p}]}],
 "behaviors": [{"behavior": "a", "task": "A", "efficacy": 3}, {behavior: b, task: B}, {behavior: c,
    task: C}],
 "exclusivity_constraints": [{"mutually_exclusive": [A, "B", A, B ,A]},
   {"mutually_exclusive": [A,B,C]}, {mutually_exclusive: [C, B]}]}
)"};
    std::string text = samples[below(samples.size())];
    for (std::size_t i = 1 + below(4); i > 0; --i) mutate(text);
    return text;
  }

 private:
  std::size_t below(std::size_t limit) { return random_() % limit; }

  void mutate(std::string& text) {
    static const std::array<const char*, 28> pieces{
        " ",  "\n",   "#",   " # note\n", ",", "[",        "]",          "{",      "}", ":",
        ": ", "- ",   "&x ", "*x",        "'", "\"",       "!!str ",     "? ",     "~", "|\n",
        "A",  "\r\n", "  ",  "x-n: 1",    "é", "<<: *x\n", "timeout: 3", "task: B"};
    const std::size_t at = below(text.size() + 1);
    switch (below(5)) {
      case 0:
        text.erase(at, 1 + below(3));
        break;
      case 1: {
        const std::string copy = text.substr(at, below(40));
        text.insert(below(text.size() + 1), copy);
        break;
      }
      case 2: {  // a line again, at the begin of a line
        const std::size_t from = text.rfind('\n', at) + 1;
        const std::string line = text.substr(from, text.find('\n', from) + 1 - from);
        text.insert(text.rfind('\n', below(text.size() + 1)) + 1, line);
        break;
      }
      default:
        text.insert(at, pieces[below(pieces.size())]);
        break;
    }
  }

  std::mt19937 random_;
};

TEST(FixedCatalogs, DamagedOnesKeepTheirMeaning) {
  std::size_t mended = 0;
  for (unsigned seed = 1; seed <= test::rounds(10'000U); ++seed) {
    SCOPED_TRACE(seed);
    const std::string text = Mutator(seed).catalog();
    const Linted before = lint(text);
    const FixedText fixed = apply_fixes(text, before.findings);
    const Linted after = lint(fixed.text);
    ASSERT_EQ(count_errors(after), count_errors(before)) << text << "->\n" << fixed.text;
    ASSERT_EQ(after.reading.is_complete, before.reading.is_complete) << text;
    ASSERT_TRUE(same_meaning(before.reading.catalog, after.reading.catalog)) << text << "->\n"
                                                                             << fixed.text;
    ASSERT_EQ(std::count(fixed.text.begin(), fixed.text.end(), '#'),
              std::count(text.begin(), text.end(), '#'))
        << text << "->\n"
        << fixed.text;
    mended += fixed.mended.size();
  }
  EXPECT_GT(mended, test::rounds(10'000U));
}

}  // namespace
}  // namespace cbc::fixed_catalogs_test
