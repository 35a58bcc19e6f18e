// Runs the inputs that the fuzzer begins with, and the findings that were kept, through their
// targets, without libFuzzer; and what the fuzzer relies on.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/shape.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/property/property_reader.h"
#include "core/script/script.h"
#include "core/yaml/document.h"
#include "fuzz/mutator.h"
#include "fuzz/target.h"
#include "support/read_file.h"
#include "support/rounds.h"

namespace cbc::fuzz::corpus_test {
namespace {

namespace fs = std::filesystem;

std::string name_of(const testing::TestParamInfo<Target>& info) {
  return std::string(info.param.name);
}

std::vector<Target> all_targets() {
  const auto all = targets();
  return {all.begin(), all.end()};
}

class Corpus : public testing::TestWithParam<Target> {};

TEST_P(Corpus, Seeds) {
  const std::vector<std::string> seeds = seeds_of(GetParam());
  ASSERT_FALSE(seeds.empty());
  for (const std::string& seed : seeds) {
    SCOPED_TRACE(seed);
    GetParam().run(seed);
  }
}

TEST_P(Corpus, Regressions) {
  const fs::path folder = fs::path(CBC_SOURCE_DIR "/tests/fuzz/regressions") / GetParam().name;
  if (!fs::exists(folder)) return;
  for (const auto& file : fs::directory_iterator(folder)) {
    SCOPED_TRACE(file.path().string());
    GetParam().run(test::read_file(file.path()));
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, Corpus, testing::ValuesIn(all_targets()), name_of);

/// A change as libFuzzer might make it.
std::string flip_a_bit(std::string text, std::size_t most) {
  if (text.empty()) return std::string(std::min<std::size_t>(most, 1), 'x');
  text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 0x04);
  text.resize(std::min(text.size(), most));
  return text;
}

bool is_yaml(std::string_view text) {
  Diagnostics diagnostics;
  return yaml::parse(text, "input", diagnostics) != nullptr;
}

// What the mutator is for: most of its catalogs get past the parser.
TEST(Mutator, KeepsYamlValid) {
  const Target target = catalog_target();
  int valid = 0;
  int changed = 0;
  const int tries = test::rounds(2000);
  const std::vector<std::string> seeds = seeds_of(target);
  for (int i = 0; i < tries; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    const std::string& before = seeds[seed % seeds.size()];
    const std::string after = mutate(target, before, target.longest, seed, flip_a_bit);
    EXPECT_LE(after.size(), target.longest);
    if (is_yaml(after)) ++valid;
    if (after != before) ++changed;
  }
  EXPECT_GT(valid, tries * 8 / 10);
  EXPECT_GT(changed, tries * 9 / 10);
}

TEST(Mutator, LeavesTheCatalogOfAScriptAlone) {
  const Target target = script_target();
  for (const std::string& seed : seeds_of(target)) {
    const std::string after = mutate(target, seed, target.longest, seed.size(), flip_a_bit);
    EXPECT_EQ(split_parts(after).front(), split_parts(seed).front());
  }
}

TEST(Tree, WritesWhatItReads) {
  for (const std::string& seed : seeds_of(catalog_target())) {
    const auto tree = read_tree(seed);
    if (!tree) continue;
    for (const Language language : {Language::yaml, Language::json}) {
      const std::string text = write_tree(*tree, language);
      const auto again = read_tree(text);
      ASSERT_TRUE(again) << text;
      EXPECT_EQ(write_tree(*again, language), text);
    }
  }
}

TEST(Parts, AreSplitAsTheyAreJoined) {
  const std::vector<std::string> parts{"a: 1\n", "", "b\n"};
  EXPECT_EQ(join_parts(parts), "a: 1\n%%%\n%%%\nb\n");
  EXPECT_EQ(split_parts(join_parts(parts)), parts);
  EXPECT_EQ(split_parts("%%%"), std::vector<std::string>{"%%%"});
}

TEST(Dictionary, HasAllKeysAndRules) {
  const std::set<std::string_view> words(dictionary().begin(), dictionary().end());
  for (const yaml::Shape* const top : {&shape::catalog,       &shape::default_values,
                                       &shape::task_defaults, &shape::behavior_defaults,
                                       &shape::behavior,      &shape::performance,
                                       &shape::requirement,   &shape::task,
                                       &shape::parameter,     &shape::exclusivity_list,
                                       &shape::variable,      &shape::script,
                                       &shape::event,         &shape::expectation,
                                       &shape::finished_task, &shape::property_file,
                                       &shape::assumptions,   &shape::faults,
                                       &shape::property,      &shape::condition}) {
    for (const yaml::Key& key : top->keys) EXPECT_TRUE(words.contains(key.name)) << key.name;
  }
  for (const Rule& rule : all_rules()) EXPECT_TRUE(words.contains(rule.name)) << rule.name;
}

}  // namespace
}  // namespace cbc::fuzz::corpus_test
