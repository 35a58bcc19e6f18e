#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"
#include "graph/report/graph_report.h"
#include "property/random.h"
#include "runtime/base/text.h"

namespace cbc::draw::draw_test {
namespace {

/// A catalog, read and compiled; all that graphs have views of.
struct Subject {
  std::unique_ptr<const yaml::Document> document;
  Diagnostics diagnostics;
  CatalogReading reading;
  CompiledCatalog compiled;  ///< empty if there are errors
};

std::unique_ptr<Subject> understand(const std::string& text) {
  auto subject = std::make_unique<Subject>();
  subject->document = yaml::parse(text, "catalog.yaml", subject->diagnostics);
  if (subject->document == nullptr) throw std::logic_error("no YAML: " + text);
  subject->reading = understand_catalog(*subject->document, subject->diagnostics);
  if (!subject->diagnostics.has_errors()) subject->compiled = compile(subject->reading.catalog);
  return subject;
}

CatalogGraph graph_of_reading(const Subject& subject) {
  return to_graph(subject.reading, subject.diagnostics.all());
}

std::string show(const CatalogGraph& graph, const Part& part) {
  std::string text;
  for (const std::uint32_t task : part.tasks) {
    text += std::string(graph.tasks[task].name) + (part.is_beside[task] ? "* " : " ");
  }
  text += "|";
  for (const std::uint32_t behavior : part.behaviors) {
    text += " " + std::string(graph.behaviors[behavior].name);
  }
  return text;
}

std::string around(const CatalogGraph& graph, const std::string& task, const Reach& reach) {
  const auto found = std::find_if(graph.tasks.begin(), graph.tasks.end(),
                                  [&](const auto& one) { return one.name == task; });
  const auto place = static_cast<std::uint32_t>(found - graph.tasks.begin());
  return show(graph, part_around(graph, {place}, reach));
}

constexpr Reach up(std::uint32_t depth) { return {true, false, depth}; }
constexpr Reach down(std::uint32_t depth) { return {false, true, depth}; }

// A requires B and C, B requires C, C requires D; c2 also performs E, which A excludes F beside.
constexpr const char* chain = R"(
behaviors:
- {behavior: a1, task: A, requires: [{task: B}, {task: C}]}
- {behavior: a2, task: A}
- {behavior: b1, task: B, requires: [{task: C}]}
- {behavior: c1, task: C, requires: [{task: D}]}
- {behavior: c2, tasks: [{task: C}, {task: E}]}
- {behavior: d1, task: D}
- {behavior: f1, task: F}
- {behavior: g1, task: G}
tasks: [{task: A}, {task: B}, {task: C}, {task: D}, {task: E}, {task: F}, {task: G}]
exclusivity_constraints:
- mutually_exclusive: [F, A]
)";

TEST(Part, GoesDownStepByStep) {
  const auto subject = understand(chain);
  const CatalogGraph graph = to_graph(subject->compiled);
  EXPECT_EQ(around(graph, "A", down(0)), "A F* | a1 a2");
  EXPECT_EQ(around(graph, "A", down(1)), "A B C E* F* | a1 a2 b1 c1 c2");
  EXPECT_EQ(around(graph, "A", down(2)), "A B C D E* F* | a1 a2 b1 c1 c2 d1");
  EXPECT_EQ(around(graph, "A", {false, true, {}}), "A B C D E* F* | a1 a2 b1 c1 c2 d1");
}

TEST(Part, GoesUpStepByStep) {
  const auto subject = understand(chain);
  const CatalogGraph graph = to_graph(subject->compiled);
  EXPECT_EQ(around(graph, "D", up(0)), "D | d1");
  EXPECT_EQ(around(graph, "D", up(1)), "C D | c1 d1");
  EXPECT_EQ(around(graph, "D", up(2)), "A B C D | a1 b1 c1 d1");
  EXPECT_EQ(around(graph, "D", {true, false, {}}), "A B C D | a1 b1 c1 d1");
}

TEST(Part, GoesBothWaysButNotBack) {
  const auto subject = understand(chain);
  const CatalogGraph graph = to_graph(subject->compiled);
  EXPECT_EQ(around(graph, "B", {}), "A B C D E* | a1 b1 c1 c2 d1");
  EXPECT_EQ(around(graph, "G", {}), "G | g1");
}

TEST(Part, OfAGroupHasAllOfIt) {
  const auto subject = understand(chain);
  const CatalogGraph graph = to_graph(subject->compiled);
  EXPECT_EQ(show(graph, part_of_group(graph, 0)), "A B C D E F | a1 a2 b1 c1 c2 d1 f1");
  EXPECT_EQ(show(graph, part_of_group(graph, 1)), "G | g1");
}

TEST(Part, ManyExclusiveTasksAreCountedInstead) {
  std::string text = "behaviors:\n";
  std::string names;
  for (char name = 'A'; name <= 'I'; ++name) {
    text += std::string("- {behavior: b") + name + ", task: " + name + "}\n";
    names += std::string(names.empty() ? "" : ", ") + name;
  }
  text += "exclusivity_constraints:\n- mutually_exclusive: [" + names + "]\n";
  const auto subject = understand(text);
  const CatalogGraph graph = to_graph(subject->compiled);
  const Diagram diagram = make_diagram(graph, part_around(graph, {4}, {}), {});
  ASSERT_EQ(diagram.nodes.size(), 3U);
  EXPECT_EQ(diagram.nodes.back().kind, NodeKind::hub);
  EXPECT_EQ(diagram.nodes.back().left_out, 8U);
}

/// How the only list of so many exclusive tasks, of two behaviors each, is drawn.
std::vector<std::size_t> pairs_and_hubs(std::size_t tasks, View view,
                                        ExclusivityStyle style = ExclusivityStyle::pairs) {
  std::string text = "behaviors:\n";
  std::string list;
  for (std::size_t task = 0; task < tasks; ++task) {
    const std::string number = std::to_string(task);
    for (const char* const behavior : {"A", "B"}) {
      text += "- {behavior: " + (behavior + number) + ", task: T" + number + "}\n";
    }
    list += (task == 0 ? "T" : ", T") + number;
  }
  text += "exclusivity_constraints: [mutually_exclusive: [" + list + "]]\n";
  const auto subject = understand(text);
  const CatalogGraph graph = to_graph(subject->compiled);
  const Diagram diagram =
      make_diagram(graph, whole(graph), {view, style, Clustering::nothing, false});
  const auto hubs = std::count_if(diagram.nodes.begin(), diagram.nodes.end(),
                                  [](const Node& node) { return node.kind == NodeKind::hub; });
  const auto lines =
      std::count_if(diagram.edges.begin(), diagram.edges.end(),
                    [](const Edge& edge) { return edge.kind == EdgeKind::exclusion; });
  return {static_cast<std::size_t>(lines), static_cast<std::size_t>(hubs)};
}

TEST(Exclusions, ArePairsOfAllNodes) {
  using Counts = std::vector<std::size_t>;
  EXPECT_EQ(pairs_and_hubs(3, View::constraints), (Counts{3, 0}));
  // There each task has two nodes.
  EXPECT_EQ(pairs_and_hubs(3, View::behaviors), (Counts{12, 0}));
}

TEST(Names, IdsDiffer) {
  EXPECT_EQ(id_of("task", "HOVER_2"), "task:HOVER_2");
  EXPECT_EQ(id_of("task", "a b:c\"<日>"), "task:a b:c\"<日>");
  EXPECT_EQ(id_of("task", "50%"), "task:50%25");
  EXPECT_EQ(id_of("task", "%25"), "task:%2525");
  EXPECT_EQ(id_of("task", "#\\&\n\xFF"), "task:%23%5C%26%0A%FF");
  EXPECT_EQ(id_of("task", "\xE2\x80\xAE"), "task:%E2%80%AE");  // turns the direction
}

TEST(Names, LabelsCanBeSeen) {
  EXPECT_EQ(label_of("a\nb"), "a\\nb");
  EXPECT_EQ(label_of("  "), "'  '");
  EXPECT_EQ(label_of("ä"), "ä");
  EXPECT_EQ(format_percent(705'000), "70.5 %");
  EXPECT_EQ(at_least(800'000), "≥ 80 %");
}

std::string all_formats(const CatalogGraph& graph) {
  std::string text;
  for (const View view : {View::full, View::tasks, View::constraints, View::behaviors}) {
    for (const ExclusivityStyle style : {ExclusivityStyle::pairs, ExclusivityStyle::hubs}) {
      const Diagram diagram =
          make_diagram(graph, whole(graph), {view, style, Clustering::groups, false});
      text += graph_dot(diagram) + graph_mermaid(diagram) + graph_json(diagram);
    }
  }
  return text;
}

// Of a good catalog, what was read and what was compiled look alike.
TEST(CatalogGraph, IsTheSameFromBothForms) {
  const auto subject = understand(chain);
  EXPECT_EQ(all_formats(graph_of_reading(*subject)), all_formats(to_graph(subject->compiled)));
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    oracle::Random random(seed);
    const std::size_t tasks = 1 + random.below(9);
    std::string text =
        "situation:\n- {variable: V, values: [x, y, z]}\n- {variable: W}\nbehaviors:\n";
    const char* const conditions[] = {"", "V: z", "W: true, V: [y, x]", "W: [false, true]"};
    for (std::size_t i = 0; i < tasks + random.below(6); ++i) {
      const std::size_t task = i < tasks ? i : random.below(tasks);
      text += "- {behavior: b" + std::to_string(i) + ", tasks: [{task: t" + std::to_string(task) +
              "}], suitability: " + std::to_string(random.below(101)) + ", situation: {" +
              conditions[random.below(std::size(conditions))] + "}, requires: [";
      for (std::size_t more = random.below(4); more > 0 && task + 1 < tasks; --more) {
        text += "{task: t" + std::to_string(task + 1 + random.below(tasks - task - 1)) +
                ", minimum_performance: " + std::to_string(random.below(60)) + "}, ";
      }
      text += "]}\n";
    }
    text += "exclusivity_constraints:\n";
    for (std::size_t lists = 1 + random.below(3); lists > 0; --lists) {
      text += "- mutually_exclusive: [t0";
      for (std::size_t more = random.below(4); more > 0; --more) {
        text += ", t" + std::to_string(random.below(tasks));
      }
      text += "]\n";
    }
    const auto random_subject = understand(text);
    if (random_subject->diagnostics.has_errors()) continue;  // exclusive requirements
    ASSERT_EQ(all_formats(graph_of_reading(*random_subject)),
              all_formats(to_graph(random_subject->compiled)))
        << text;
  }
}

std::vector<std::string> faults(const CatalogGraph& graph) {
  const Diagram diagram = make_diagram(graph, whole(graph), {});
  std::vector<std::string> found;
  for (const Node& node : diagram.nodes) {
    if (node.mark == Mark::faulty) found.push_back(node.id);
  }
  for (const Edge& edge : diagram.edges) {
    if (edge.mark != Mark::faulty) continue;
    found.push_back(diagram.nodes[edge.from].id + " -> " + diagram.nodes[edge.to].id);
  }
  return found;
}

using Faults = std::vector<std::string>;

TEST(CatalogGraph, UndefinedTasksAreDrawn) {
  const auto subject = understand(
      "behaviors:\n"
      "- {behavior: a, task: A, requires: [{task: X, minimum_performance: 40}]}\n"
      "- {behavior: b, task: B, requires: [{task: X}]}\n"
      "exclusivity_constraints:\n"
      "- mutually_exclusive: [A, X, Y]\n");
  const CatalogGraph graph = graph_of_reading(*subject);
  ASSERT_EQ(graph.tasks.size(), 4U);
  EXPECT_EQ(graph.tasks[2].name, "X");
  EXPECT_FALSE(graph.tasks[2].is_defined);
  EXPECT_EQ(graph.tasks[3].name, "Y");
  ASSERT_EQ(graph.requirements.size(), 2U);
  EXPECT_EQ(graph.requirements[0].minimum_performance, 400'000U);
  EXPECT_EQ(faults(graph),
            (Faults{"task:X", "task:Y", "behavior:a -> task:X", "behavior:b -> task:X"}));
}

TEST(CatalogGraph, BehaviorsOfOneNameHaveIdsOfTheirOwn) {
  const auto subject = understand(
      "behaviors:\n"
      "- {behavior: a, task: A}\n"
      "- {behavior: a, task: B}\n"
      "- {task: C}\n"
      "- {behavior: 'a#2', task: A}\n");
  const CatalogGraph graph = graph_of_reading(*subject);
  EXPECT_EQ(faults(graph), (Faults{"behavior:a", "behavior:a#2", "behavior:"}));
  const Diagram diagram = make_diagram(graph, whole(graph), {});
  EXPECT_EQ(diagram.nodes.back().id, "behavior:a%232");
}

}  // namespace
}  // namespace cbc::draw::draw_test
