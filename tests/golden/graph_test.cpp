// What `cbc graph` makes of files, terminals and Graphviz; the cases have the rest.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "file/filter.h"
#include "golden/process.h"
#include "unit/scratch_folder.h"

namespace cbc::golden {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

fs::path catalog() { return fs::path(CBC_SOURCE_DIR) / "catalogs" / "quadrotor.yaml"; }

Result graph(const fs::path& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "graph");
  return run({.arguments = std::move(arguments), .folder = folder});
}

bool has_graphviz() { return run_filter({"dot", "-V"}, "").is_found; }

TEST(Graph, OfACompiledCatalogIsThatOfItsSource) {
  const ScratchFolder folder;
  fs::copy_file(catalog(), folder / "robot.yaml");
  ASSERT_EQ(run({.arguments = {"compile", "robot.yaml"}, .folder = folder.path()}).status, 0);
  for (const std::string format : {"dot", "mermaid", "json"}) {
    for (const std::string view : {"full", "tasks", "constraints", "behaviors"}) {
      const Result source =
          graph(folder.path(), {"robot.yaml", "--format", format, "--view", view});
      const Result compiled =
          graph(folder.path(), {"robot.cbc", "--format", format, "--view", view});
      EXPECT_EQ(source.status, 0);
      EXPECT_EQ(compiled.status, 0) << compiled.err;
      EXPECT_EQ(source.out, compiled.out) << format << ' ' << view;
    }
  }
}

TEST(Graph, SuffixOfTheOutputNamesTheFormat) {
  const ScratchFolder folder;
  const auto begins_with = [&](const std::string& name, const std::string& text) {
    const Result result = graph(folder.path(), {catalog().string(), "-o", name});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out, "");
    const std::string content = folder.read(name);
    EXPECT_EQ(content.substr(0, text.size()), text) << name;
  };
  begins_with("a.dot", "digraph ");
  begins_with("a.gv", "digraph ");
  begins_with("a", "digraph ");
  begins_with("a.mmd", "flowchart LR");
  begins_with("a.json", R"({"schema":"cbc.graph/1")");
  if (!has_graphviz()) GTEST_SKIP() << "there is no Graphviz (Debian: apt install graphviz)";
  begins_with("a.svg", "<?xml ");
  begins_with("a.png", "\x89PNG");
  begins_with("a.pdf", "%PDF-");
}

TEST(Graph, PicturesDoNotDependOnTheClock) {
  if (!has_graphviz()) GTEST_SKIP() << "there is no Graphviz (Debian: apt install graphviz)";
  const ScratchFolder folder;
  const Result picture = graph(folder.path(), {catalog().string(), "--format", "pdf"});
  EXPECT_EQ(picture.status, 0);
  EXPECT_NE(picture.out.find("/CreationDate (D:19700101"), std::string::npos);
}

TEST(Graph, WithoutGraphvizAPictureIsRefused) {
  const ScratchFolder folder;
  folder.write("a.svg", "before");
  const Result result = run({.arguments = {"graph", catalog().string(), "-o", "a.svg"},
                             .folder = folder.path(),
                             .environment = {{"PATH", folder.path()}}});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err,
            "cbc: svg needs Graphviz (Debian: apt install graphviz): cannot run 'dot': No such "
            "file or directory\n");
  EXPECT_EQ(folder.read("a.svg"), "before");
}

TEST(Graph, WhatGraphvizSaysIsPassedOn) {
  const ScratchFolder folder;
  const std::string dot = folder / "dot";
  folder.write("dot", "#!/bin/sh\necho 'no fonts today' >&2\nexit 1\n");
  fs::permissions(dot, fs::perms::owner_all);
  const Result result = run({.arguments = {"graph", catalog().string(), "--format", "svg"},
                             .folder = folder.path(),
                             .environment = {{"PATH", folder.path()}}});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "cbc: Graphviz cannot draw it as svg: no fonts today\n");
}

TEST(Graph, BinaryPicturesAreNotWrittenToATerminal) {
  for (const std::string format : {"png", "pdf"}) {
    const ScratchFolder folder;
    const Result result = run_on_terminal(
        {.arguments = {"graph", catalog().string(), "--format", format}, .folder = folder.path()});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out,
              "cbc: " + format + " is not written to a terminal; expected -o OUT or a pipe\r\n");
  }
}

}  // namespace
}  // namespace cbc::golden
