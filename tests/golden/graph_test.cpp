// What `cbc graph` makes of files, terminals and Graphviz; the cases have the rest.
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/support/system.h"
#include "golden/process.h"
#include "support/scratch_folder.h"

namespace cbc::golden::graph_test {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;
using Json = nlohmann::json;

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

/// The tasks that run with one of their behaviors, by the lines of a picture.
Json running_in(const Json& picture) {
  Json running = Json::object();
  const auto name = [](const Json& id) {
    const auto text = id.get<std::string>();
    return text.substr(text.find(':') + 1);
  };
  for (const Json& edge : picture["edges"]) {
    const bool is_in_use = edge["mark"] == "active" || edge["mark"] == "started";
    if (edge["kind"] == "performed_by" && is_in_use) running[name(edge["from"])] = name(edge["to"]);
  }
  return running;
}

Json requests_in(const Json& picture) {
  Json requests = Json::object();
  for (const Json& node : picture["nodes"]) {
    if (node["kind"] != "task" || node["priority"].is_null()) continue;
    requests[node["name"].get<std::string>()] = node["priority"];
  }
  return requests;
}

/// "1. activated" and the like, with the behaviors, in order.
std::map<std::size_t, std::string> changes_in(const Json& picture) {
  std::map<std::size_t, std::string> changes;
  for (const Json& node : picture["nodes"]) {
    for (const Json& one : node["notes"]) {
      const auto note = one.get<std::string>();
      const std::size_t dot = note.find(". ");
      if (dot == std::string::npos) continue;
      changes[std::stoul(note)] = note.substr(dot + 2) + " " + node["name"].get<std::string>();
    }
  }
  return changes;
}

std::map<std::size_t, std::string> changes_of(const Json& event) {
  std::map<std::size_t, std::string> changes;
  for (const Json& change : event["changes"]) {
    const auto operation = change["op"].get<std::string>();
    const std::string ending = change["success"] == true ? "d " : "";
    changes[changes.size() + 1] =
        (ending.empty() ? operation.substr(0, operation.size() - 1) + "ion failed " : operation) +
        ending + change["behavior"].get<std::string>();
  }
  return changes;
}

// Every state of a mission, against the other command that tells it.
TEST(Graph, StateAfterAnEventIsThatOfSolve) {
  const ScratchFolder folder;
  fs::copy_file(catalog(), folder / "robot.yaml");
  ASSERT_EQ(run({.arguments = {"compile", "robot.yaml"}, .folder = folder.path()}).status, 0);
  const std::string mission = fs::path(catalog()).replace_filename("quadrotor.mission.yaml");
  const Result solved = run(
      {.arguments = {"solve", "robot.yaml", mission, "--format", "json"}, .folder = folder.path()});
  ASSERT_EQ(solved.status, 0) << solved.err;
  const Json events = Json::parse(solved.out)["runs"][0]["events"];
  ASSERT_GT(events.size(), 15U);
  std::size_t failures = 0;
  for (const Json& event : events) {
    const std::string index = std::to_string(event["index"].get<int>());
    SCOPED_TRACE(index);
    const std::vector<std::string> arguments{"--script", mission,    "--after",
                                             index,      "--format", "json"};
    std::vector<std::string> of_source = arguments;
    of_source.insert(of_source.begin(), "robot.yaml");
    std::vector<std::string> of_compiled = arguments;
    of_compiled.insert(of_compiled.begin(), "robot.cbc");
    const Result drawn = graph(folder.path(), of_source);
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    EXPECT_EQ(graph(folder.path(), of_compiled).out, drawn.out);
    const Json picture = Json::parse(drawn.out);
    EXPECT_EQ(picture["state"]["index"], event["index"]);
    EXPECT_EQ(picture["state"]["time"], event["time"]);
    EXPECT_EQ(running_in(picture), event["running"]);
    EXPECT_EQ(requests_in(picture), event["requests"]);
    EXPECT_EQ(changes_in(picture), changes_of(event));
    for (const Json& change : event["changes"]) {
      if (change["success"] == false) ++failures;
    }
  }
  EXPECT_GT(failures, 0U);
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

TEST(Graph, SaysWhereMermaidWouldNotDrawAPicture) {
  for (const std::size_t edges : {500U, 501U}) {
    std::string text = "behaviors:\n";
    for (std::size_t i = 0; i < edges; ++i)
      text += fmt::format("- {{behavior: B{}, task: A}}\n", i);
    const ScratchFolder folder;
    folder.write("robot.yaml", text);
    const Result mermaid = graph(folder.path(), {"robot.yaml", "--format", "mermaid"});
    EXPECT_EQ(mermaid.status, 0);
    EXPECT_EQ(mermaid.err.find("Mermaid draws at most 500") != std::string::npos, edges > 500)
        << mermaid.err;
    EXPECT_EQ(graph(folder.path(), {"robot.yaml", "--format", "dot"}).err, "");
  }
}

TEST(Graph, PicturesDoNotDependOnTheClock) {
  if (!has_graphviz()) GTEST_SKIP() << "there is no Graphviz (Debian: apt install graphviz)";
  const ScratchFolder folder;
  const Result picture = graph(folder.path(), {catalog().string(), "--format", "pdf"});
  EXPECT_EQ(picture.status, 0);
  if (picture.out.find("/CreationDate") == std::string::npos) {
    // Newer versions of Cairo compress it.
    std::this_thread::sleep_for(std::chrono::milliseconds(1'100));
    EXPECT_EQ(graph(folder.path(), {catalog().string(), "--format", "pdf"}).out, picture.out);
  } else {
    EXPECT_NE(picture.out.find("/CreationDate (D:19700101"), std::string::npos);
  }
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

/// A picture where Graphviz is this shell script.
Result draw_with(const std::string& script) {
  const ScratchFolder folder;
  folder.write("dot", "#!/bin/sh\n" + script);
  fs::permissions(folder / "dot", fs::perms::owner_all);
  return run({.arguments = {"graph", catalog().string(), "--format", "svg"},
              .folder = folder.path(),
              .environment = {{"PATH", folder.path()}}});
}

TEST(Graph, WhatGraphvizSaysIsPassedOn) {
  const Result result = draw_with("echo 'no fonts today' >&2\nexit 1\n");
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "cbc: Graphviz cannot draw it as svg: no fonts today\n");
}

TEST(Graph, GraphvizMayFailWithoutAWord) {
  for (const auto& [script, reason] :
       std::vector<std::pair<std::string, std::string>>{{"exit 1\n", "exit status 1"},
                                                        {"kill -9 $$\n", "ended by signal 9"},
                                                        {"exit 0\n", "it wrote nothing"}}) {
    const Result result = draw_with(script);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.err, "cbc: Graphviz cannot draw it as svg: " + reason + "\n");
  }
}

/// A catalog of 2,001 tasks that start on request, and of as many values of a variable.
TEST(Graph, TablesOfMillionsOfPairsAreRefused) {
  const test::ScratchFolder folder;
  std::string behaviors;
  for (int number = 0; number <= 2000; ++number) {
    const std::string digits = std::to_string(number);
    behaviors += "- {behavior: B" + digits + ", task: T" + digits + "}\n";
  }
  folder.write("large.yaml", "behaviors:\n" + behaviors);
  const std::string large = folder / "large.yaml";
  const Result result = run({{"graph", large, "--view", "together"}, CBC_SOURCE_DIR});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err,
            "cbc: catalog '" + large +
                "' has too many tasks for a table of their pairs: 2001; expected at most 2000\n");
}

TEST(Graph, BinaryPicturesAreNotWrittenToATerminal) {
  for (const std::string format : {"png", "pdf"}) {
    const ScratchFolder folder;
    Result result;
    try {
      result = run_on_terminal({.arguments = {"graph", catalog().string(), "--format", format},
                                .folder = folder.path()});
    } catch (const std::system_error& error) {
      GTEST_SKIP() << "no terminal here: " << error.what();
    }
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out,
              "cbc: " + format + " is not written to a terminal; expected -o OUT or a pipe\r\n");
  }
}

}  // namespace
}  // namespace cbc::golden::graph_test
