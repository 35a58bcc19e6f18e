#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "unit/findings.h"

namespace cbc::same_meaning_test {
namespace {

Catalog read(const std::string& text) {
  Diagnostics diagnostics;
  auto catalog = read_catalog(text, "a.yaml", diagnostics);
  EXPECT_TRUE(catalog.has_value()) << text << show(diagnostics);
  return catalog.value_or(Catalog{});
}

bool same(const std::string& a, const std::string& b) {
  const bool result = same_meaning(read(a), read(b));
  EXPECT_EQ(same_meaning(read(b), read(a)), result) << a << b;
  return result;
}

const std::string sample = R"(
default_values: {tasks: {timeout: 15}, behaviors: {package: p}}
behaviors:
- {behavior: a, task: A, suitability: 90, requires: [{task: B, minimum_performance: 50}]}
- {behavior: b, task: B, timeout: 3}
- {behavior: c, tasks: [{task: C}, {task: D, suitability: 20}]}
tasks:
- {task: A, minimum_performance: 10, parameters: [{parameter: p, allowed_values: [1, 2]}]}
- {task: B, start_on_request: no}
- {task: C, execution_goal: keep_running}
- {task: D, reactive_start: yes}
- {task: E}
exclusivity_constraints:
- mutually_exclusive: [A, C, E]
- mutually_exclusive: [D, E]
)";

std::string with(const std::string& part, const std::string& replacement) {
  std::string text = sample;
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), replacement);
}

TEST(SameMeaning, PlacesAndSpellingsDoNotCount) {
  EXPECT_TRUE(same(sample, sample));
  EXPECT_TRUE(same(sample, "# comment\n\n" + sample));
  EXPECT_TRUE(same(sample, with("suitability: 90", "efficacy: 90.0")));
  EXPECT_TRUE(same(sample, with("- {task: E}", "- task: E\n  timeout: 15")));
  EXPECT_TRUE(same(sample, with("[A, C, E]", "[E, A, C, A]")));
  EXPECT_TRUE(same(sample, sample + "- mutually_exclusive: [C, A]\n- mutually_exclusive: [A]\n"));
  EXPECT_TRUE(same(sample, with("requires: [", "requires: [{task: B}, ")));
  EXPECT_TRUE(
      same(sample, with("allowed_values: [1, 2]}",
                        "allowed_values: [1, 2]}, {parameter: p, allowed_values: [1, 2]}")));
}

TEST(SameMeaning, EverythingElseCounts) {
  const std::pair<std::string, std::string> changes[] = {
      {"timeout: 15", "timeout: 16"},
      {"package: p", "package: q"},
      {"behavior: a", "behavior: aa"},
      {"suitability: 90", "suitability: 91"},
      {"minimum_performance: 50", "minimum_performance: 51"},
      {"requires: [{task: B, minimum_performance: 50}]", "timeout: ~"},
      {"requires: [", "requires: [{task: D}, "},
      {"timeout: 3", "timeout: 4"},
      {", timeout: 3", ""},
      {"suitability: 20", "suitability: 21"},
      {"{task: C}, {task: D", "{task: E}, {task: D"},
      {"minimum_performance: 10", "minimum_performance: 11"},
      {"parameter: p", "parameter: q"},
      {"[1, 2]", "[1, 3]"},
      {"[1, 2]", "1"},
      {"allowed_values: [1, 2]}",
       "allowed_values: [1, 2]}, {parameter: p, allowed_values: [1, 3]}"},
      {"start_on_request: no", "start_on_request: yes"},
      {"keep_running", "achieve_goal"},
      {"reactive_start: yes", "start_on_request: no"},
      {"- {task: E}\n", "- {task: E}\n- {task: F}\n"},
      {"- {task: D, reactive_start: yes}\n- {task: E}",
       "- {task: E}\n- {task: D, reactive_start: yes}"},
      {"[A, C, E]", "[A, C]"},
      {"[A, C, E]", "[A, C, D, E]"},
      {"[D, E]", "[C, D]"},
      {"- mutually_exclusive: [D, E]\n", ""},
  };
  for (const auto& [part, replacement] : changes) {
    EXPECT_FALSE(same(sample, with(part, replacement))) << part << " -> " << replacement;
  }
  EXPECT_FALSE(same("behaviors: [{behavior: a, task: A}]",
                    "behaviors: [{behavior: a, task: A}]\n"
                    "tasks: [{task: A}]"));
}

}  // namespace
}  // namespace cbc::same_meaning_test
