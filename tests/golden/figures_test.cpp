// The figures are kept as Graphviz drew them. Its versions draw differently, so they are compared
// with the DOT they come from: names, texts and colors of all nodes and edges. The DOT is that of
// the command beside a figure in docs/graphs.md, or a file beside the figure.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "golden/process.h"
#include "support/read_file.h"

namespace cbc::golden::figures_test {
namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;
using Lines = std::vector<std::string>;

/// "cbc graph … -o docs/figures/NAME.svg", in docs/graphs.md, as words.
std::vector<Words> commands_of_page() {
  std::ifstream page(fs::path(CBC_SOURCE_DIR) / "docs" / "graphs.md");
  std::vector<Words> commands;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("cbc graph ") || line.find(" -o docs/figures/") == std::string::npos) {
      continue;
    }
    std::istringstream words(line.substr(4, line.find('#') - 4));
    commands.emplace_back();
    for (std::string word; words >> word;) commands.back().push_back(word);
  }
  return commands;
}

std::string replace_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// What a group of a regular expression finds first, or nothing.
std::string find(const std::string& text, const std::string& pattern) {
  std::smatch match;
  return std::regex_search(text, match, std::regex(pattern)) ? match[1].str() : std::string();
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char byte) { return static_cast<char>(std::tolower(byte)); });
  return text;
}

/// Newer versions of Graphviz name some colors.
std::string color(const std::string& text) {
  if (text == "black") return "#000000";
  return text == "white" ? "#ffffff" : lower(text);
}

/// "task:HOVER | HOVER1. activated | #000000 | #ffffff", of each node, edge and cluster; the
/// caption.
Lines lines_of_dot(const std::string& dot) {
  Lines lines;
  std::istringstream text(dot);
  for (std::string line; std::getline(text, line);) {
    const std::string label = replace_all(find(line, R"re([ \[]label="([^"]*)")re"), "\\n", "");
    if (line.starts_with("  labelloc")) lines.push_back(label);
    if (!line.starts_with("  \"") && !line.starts_with("  subgraph")) continue;
    const std::string to = find(line, R"re(^  "[^"]*" -> "([^"]*)")re");
    lines.push_back(fmt::format(
        "{}{} | {} | {} | {}", find(line, R"re(^  (?:subgraph )?"([^"]*)")re"),
        to.empty() ? "" : "->" + to, label, lower(find(line, R"re([ \[]color="([^"]*)")re")),
        lower(find(line, R"re(fillcolor="([^"]*)")re"))));
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

/// The same of a picture.
Lines lines_of_svg(std::string svg) {
  svg = replace_all(replace_all(std::move(svg), "&#45;", "-"), "&gt;", ">");
  Lines lines;
  const std::regex item(R"(<title>([^<]*)</title>([^]*?)(</g>|<!--|<g ))");
  for (std::sregex_iterator at(svg.begin(), svg.end(), item), end; at != end; ++at) {
    const std::string title = (*at)[1];
    const std::string body = (*at)[2];
    std::string label;
    const std::regex text("<text[^>]*>([^<]*)</text>");
    for (std::sregex_iterator word(body.begin(), body.end(), text); word != end; ++word) {
      label += (*word)[1];
    }
    if (at == std::sregex_iterator(svg.begin(), svg.end(), item)) {  // the picture itself
      if (!label.empty()) lines.push_back(label);
      continue;
    }
    const bool is_edge = title.find("->") != std::string::npos;
    lines.push_back(fmt::format("{} | {} | {} | {}", title, label,
                                color(find(body, R"re(stroke="([^"]*)")re")),
                                is_edge ? "" : color(find(body, R"re(fill="([^"]*)")re"))));
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

fs::path figures_folder() { return fs::path(CBC_SOURCE_DIR) / "docs" / "figures"; }

void expect_drawn_from(const std::string& dot, const fs::path& figure) {
  const Lines lines = lines_of_dot(dot);
  EXPECT_GT(lines.size(), 5U);
  EXPECT_EQ(lines_of_svg(test::read_file(figure)), lines) << "draw it anew: " << figure;
}

TEST(Figures, AreWhatTheyAreDrawnFrom) {
  std::set<fs::path> drawn;
  for (Words command : commands_of_page()) {
    const fs::path figure = fs::path(CBC_SOURCE_DIR) / command.back();
    drawn.insert(figure.filename());
    ASSERT_EQ(command[command.size() - 2], "-o");
    command.resize(command.size() - 2);
    const Result result = run({command, CBC_SOURCE_DIR});
    ASSERT_EQ(result.status, 0) << result.err;
    expect_drawn_from(result.out, figure);
  }
  std::set<fs::path> kept;
  for (const auto& entry : fs::directory_iterator(figures_folder())) {
    fs::path figure = entry.path();
    if (figure.extension() == ".svg") kept.insert(figure.filename());
    if (figure.extension() != ".dot") continue;
    const std::string dot = test::read_file(figure);
    figure.replace_extension(".svg");
    drawn.insert(figure.filename());
    expect_drawn_from(dot, figure);
  }
  EXPECT_EQ(kept, drawn);
}

TEST(Figures, AreShown) {
  const std::string pages = test::read_file(fs::path(CBC_SOURCE_DIR) / "README.md") +
                            test::read_file(fs::path(CBC_SOURCE_DIR) / "docs" / "architecture.md") +
                            test::read_file(fs::path(CBC_SOURCE_DIR) / "docs" / "graphs.md");
  for (const auto& entry : fs::directory_iterator(figures_folder())) {
    if (entry.path().extension() == ".dot") continue;
    EXPECT_NE(pages.find("figures/" + entry.path().filename().string() + ")"), std::string::npos)
        << entry.path();
  }
}

}  // namespace
}  // namespace cbc::golden::figures_test
