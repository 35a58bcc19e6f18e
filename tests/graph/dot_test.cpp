// Has Graphviz read every picture, and looks at what it found in it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/support/system.h"
#include "graph/engine/diagram.h"
#include "graph/samples.h"

namespace cbc::graph_test::dot_test {
namespace {

using nlohmann::json;

bool has_graphviz() { return run_filter({"dot", "-V"}, "").is_found; }

// What is written on a node or an edge, line after line.
std::string text_of(const json& object) {
  std::string text;
  for (const json& operation : object.value("_ldraw_", json::array())) {
    if (operation.at("op") == "T") text += operation.at("text").get<std::string>();
  }
  return text;
}

bool is_node_of_catalog(const json& object) {
  const auto name = object.at("name").get<std::string>();
  return name.starts_with("task:") || name.starts_with("behavior:");
}

void check(const Sample& sample, const json& graph) {
  SCOPED_TRACE(sample.name);
  EXPECT_EQ(text_of(graph), sample.caption);
  std::size_t nodes = 0;
  std::vector<std::string> labels;
  for (const json& object : graph.value("objects", json::array())) {
    if (object.contains("nodes") || object.contains("subgraphs")) continue;  // a cluster
    ++nodes;
    if (is_node_of_catalog(object)) labels.push_back(text_of(object));
  }
  EXPECT_EQ(nodes, sample.nodes);
  EXPECT_EQ(graph.value("edges", json::array()).size(), sample.edges);
  if (sample.labels.empty()) return;
  std::sort(labels.begin(), labels.end());
  EXPECT_EQ(labels, sample.labels);
}

/// Graphviz 2.42.4 takes what its memory has behind the style of a table for arguments of it.
std::string without_arguments(const std::string& output) {
  constexpr std::string_view style = "\"style\": \"dashed";
  std::string text;
  std::size_t begin = 0;
  for (std::size_t at = 0; (at = output.find(style, begin)) != std::string::npos;) {
    at += style.size();
    text.append(output, begin, at - begin);
    begin = output[at] == '(' ? output.find('\n', at) : at;
    if (begin != at) text += '"';
  }
  return text + output.substr(begin);
}

Filtered draw(const std::vector<std::string>& command, const std::string& text) {
  Filtered picture = run_filter(command, text);
  picture.output = without_arguments(picture.output);
  return picture;
}

void check(const Sample& sample) {
  SCOPED_TRACE(sample.name);
  Filtered picture = draw({"dot", "-Tjson"}, sample.dot);
  if (!picture.is_done) picture = draw({"dot", "-Gnewrank=true", "-Tjson"}, sample.dot);
  ASSERT_TRUE(picture.is_done) << picture.error_output;
  EXPECT_EQ(picture.error_output, "");
  check(sample, json::parse(picture.output));
}

// Starting Graphviz takes longer than most pictures, so it reads many at once. If it complains of
// one, each is read alone.
void check(std::span<const Sample> samples) {
  constexpr std::size_t most = 25;
  for (; !samples.empty(); samples = samples.subspan(std::min(most, samples.size()))) {
    const auto batch = samples.first(std::min(most, samples.size()));
    std::string text;
    for (const Sample& sample : batch) text += sample.dot;
    const Filtered pictures = draw({"dot", "-Tjson"}, text);
    if (!pictures.is_done || !pictures.error_output.empty()) {
      for (const Sample& sample : batch) check(sample);
      continue;
    }
    std::istringstream output(pictures.output);
    for (const Sample& sample : batch) {
      json graph;
      output >> graph;
      check(sample, graph);
    }
  }
}

TEST(Dot, ReadsThePicturesOfAllCatalogs) {
  if (!has_graphviz()) GTEST_SKIP() << "there is no Graphviz (Debian: apt install graphviz)";
  const std::vector<Sample> samples = samples_of_files();
  EXPECT_GT(samples.size(), 500U);
  check(samples);
}

TEST(Dot, ReadsPicturesOfHostileNames) {
  if (!has_graphviz()) GTEST_SKIP() << "there is no Graphviz (Debian: apt install graphviz)";
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    check(random_samples(seed));
  }
}

TEST(Dot, ReadsPicturesOfDifferencesWithHostileNames) {
  if (!has_graphviz()) GTEST_SKIP() << "there is no Graphviz (Debian: apt install graphviz)";
  std::size_t samples = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const std::vector<Sample> drawn = random_diff_samples(seed);
    check(drawn);
    samples += drawn.size();
  }
  EXPECT_GT(samples, 80U);
}

TEST(Dot, OutputIsAPicture) {
  if (!has_graphviz()) GTEST_SKIP() << "there is no Graphviz (Debian: apt install graphviz)";
  const Filtered picture = run_filter({"dot", "-Tsvg"}, random_samples(1).front().dot);
  ASSERT_TRUE(picture.is_done) << picture.error_output;
  EXPECT_NE(picture.output.find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace cbc::graph_test::dot_test
