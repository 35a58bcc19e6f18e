// Fault trees, and the XML that other programs read.
#include "verify/engine/fault_tree.h"

#include <cstdlib>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "runtime/compiled/compiled_catalog.h"
#include "support/read_file.h"
#include "support/scratch_folder.h"
#include "unit/compiled_fixture.h"
#include "verify/engine/cut_sets.h"
#include "verify/report/open_psa.h"

namespace cbc::fault_tree_test {
namespace {

using test::compile_text;
using test::task_id;

FaultTree tree_of(const CompiledCatalog& catalog, TaskId task) {
  const auto made = make_fault_tree(catalog, task, ruled_out_by(catalog, {}));
  if (const auto* error = std::get_if<std::string>(&made)) {
    ADD_FAILURE() << *error;
    return {};
  }
  return std::get<FaultTree>(made);
}

/// The elements of the XML, without comment, labels and what is the same in all.
std::string gates_of(const CompiledCatalog& catalog, std::string_view task) {
  const std::string xml = open_psa_text(catalog, tree_of(catalog, task_id(catalog, task)));
  std::string gates;
  std::size_t at = xml.find("<define-gate");
  const std::size_t end = xml.find("</define-fault-tree>");
  while (at < end) {
    const std::size_t line_end = xml.find('\n', at);
    const std::string line = xml.substr(at, line_end - at + 1);
    if (!line.starts_with("<label>")) gates += line;
    at = line_end + 1;
  }
  return gates;
}

TEST(FaultTree, FollowsTheRequirements) {
  const CompiledCatalog catalog = compile_text(R"(behaviors:
- {behavior: a, task: A, requires: [{task: B}, {task: C}]}
- {behavior: plan, task: A, requires: [{task: E}]}
- {behavior: b, task: B}
- {behavior: c, task: C, requires: [{task: B}]}
- {behavior: d, task: C}
- {behavior: other, task: D, requires: [{task: B}]}
exclusivity_constraints:
- mutually_exclusive: [A, D]
tasks: [{task: E}]
)");
  EXPECT_EQ(gates_of(catalog, "A"), R"(<define-gate name="task-A">
<gate name="behavior-a"/>
</define-gate>
<define-gate name="behavior-a">
<or>
<basic-event name="fault-a"/>
<gate name="task-B"/>
<gate name="task-C"/>
</or>
</define-gate>
<define-gate name="task-C">
<and>
<gate name="behavior-c"/>
<basic-event name="fault-d"/>
</and>
</define-gate>
<define-gate name="behavior-c">
<or>
<basic-event name="fault-c"/>
<gate name="task-B"/>
</or>
</define-gate>
<define-gate name="task-B">
<basic-event name="fault-b"/>
</define-gate>
)") << "no behavior performs E, and D does not matter";
}

constexpr std::string_view crossing = R"(behaviors:
- {behavior: a, task: A, requires: [{task: L}, {task: R}, {task: POWER}]}
- {behavior: lx, task: L, requires: [{task: X}]}
- {behavior: ly, task: L, requires: [{task: Y}]}
- {behavior: rx, task: R, requires: [{task: X}]}
- {behavior: ry, task: R, requires: [{task: Y}]}
- {behavior: x, task: X}
- {behavior: y, task: Y}
- {behavior: battery, task: POWER}
- {behavior: cable, task: POWER}
exclusivity_constraints:
- mutually_exclusive: [X, Y]
)";

TEST(FaultTree, ListsTheWaysWhereExclusivityMatters) {
  const CompiledCatalog catalog = compile_text(crossing);
  EXPECT_EQ(tree_of(catalog, task_id(catalog, "A")).ways, 2U);
  EXPECT_EQ(gates_of(catalog, "A"), R"(<define-gate name="task-A">
<and>
<gate name="way-1"/>
<gate name="way-2"/>
</and>
</define-gate>
<define-gate name="way-1">
<or>
<basic-event name="fault-a"/>
<basic-event name="fault-lx"/>
<basic-event name="fault-rx"/>
<basic-event name="fault-x"/>
<gate name="task-POWER"/>
</or>
</define-gate>
<define-gate name="way-2">
<or>
<basic-event name="fault-a"/>
<basic-event name="fault-ly"/>
<basic-event name="fault-ry"/>
<basic-event name="fault-y"/>
<gate name="task-POWER"/>
</or>
</define-gate>
<define-gate name="task-POWER">
<and>
<basic-event name="fault-battery"/>
<basic-event name="fault-cable"/>
</and>
</define-gate>
)");
  EXPECT_EQ(tree_of(catalog, task_id(catalog, "L")).ways, 0U) << "L needs one of X and Y";
}

TEST(FaultTree, ListsTheWaysWhereAMinimumPerformanceMatters) {
  const auto catalog_with_minimum = [](int minimum) {
    return compile_text(fmt::format(R"(behaviors:
- {{behavior: a, task: A, requires: [{{task: B, minimum_performance: {}}}]}}
- {{behavior: b, task: B, suitability: 90, requires: [{{task: C}}]}}
- {{behavior: good, task: C}}
- {{behavior: bad, task: C, suitability: 50}}
)",
                                    minimum));
  };
  const CompiledCatalog always = catalog_with_minimum(45);
  EXPECT_EQ(tree_of(always, task_id(always, "A")).ways, 0U);
  const CompiledCatalog sometimes = catalog_with_minimum(46);
  EXPECT_EQ(tree_of(sometimes, task_id(sometimes, "A")).ways, 1U);
  EXPECT_EQ(tree_of(sometimes, task_id(sometimes, "B")).ways, 0U) << "it has no minimum of its own";
  const CompiledCatalog never = catalog_with_minimum(91);
  EXPECT_TRUE(tree_of(never, task_id(never, "A")).gates.empty());
}

TEST(FaultTree, IsRefusedIfItWouldBeTooLarge) {
  const CompiledCatalog catalog = compile_text(crossing);
  const TaskId task = task_id(catalog, "A");
  const std::vector<bool> ruled_out = ruled_out_by(catalog, {});
  const auto has_tree = [&](const FaultTreeLimits& limits) {
    return std::holds_alternative<FaultTree>(make_fault_tree(catalog, task, ruled_out, limits));
  };
  EXPECT_TRUE(has_tree({1000, 10}));
  EXPECT_FALSE(has_tree({1000, 9}));
  EXPECT_FALSE(has_tree({10, 10}));
  EXPECT_EQ(std::get<std::string>(make_fault_tree(catalog, task, ruled_out, {10, 10})),
            "exclusivity and minimum performances leave too many ways to run task 'A' for a fault "
            "tree");
}

TEST(FaultTree, LeavesOutWhatIsRuledOut) {
  const CompiledCatalog catalog = compile_text(crossing);
  std::vector<bool> ruled_out = ruled_out_by(catalog, {});
  ruled_out[test::behavior_id(catalog, "cable")] = true;
  ruled_out[test::behavior_id(catalog, "y")] = true;
  const auto made = make_fault_tree(catalog, task_id(catalog, "A"), ruled_out);
  const auto& tree = std::get<FaultTree>(made);
  std::string names;
  for (const BehaviorId behavior : tree.faults) {
    names += std::string(catalog.name_of_behavior(behavior)) + ' ';
  }
  EXPECT_EQ(names, "a lx rx x battery ");
  EXPECT_EQ(tree.ways, 0U) << "nothing is left that X excludes";
}

TEST(OpenPsa, IsAsWritten) {
  const CompiledCatalog catalog = compile_text(R"(behaviors:
- {behavior: "node: it's <up>", task: /task/1}
- {behavior: node__it_s__up_, task: /task/1}
)");
  const std::string head = R"(<?xml version="1.0" encoding="UTF-8"?>
<!--
Which faults of behaviors make the task of the first gate impossible.
)";
  const std::string note =
      R"(The tree is exact. Basic events have no probabilities; to add one, write for example
<float value="1e-4"/> after the label of the event.
-->
<opsa-mef>
)";
  EXPECT_EQ(open_psa_text(catalog, tree_of(catalog, 0)),
            head +
                "No exclusivity and no minimum performance matters: a task is lost when all its "
                "behaviors are lost,\nand a behavior when it is faulty or a task that it requires "
                "is lost.\n" +
                note + R"(<define-fault-tree name="_task_1-1">
<label>/task/1 in )" +
                std::string(catalog.file) + R"(</label>
<define-gate name="task-_task_1-1">
<label>/task/1 is lost</label>
<and>
<basic-event name="fault-node__it_s__up_-1"/>
<basic-event name="fault-node__it_s__up_"/>
</and>
</define-gate>
</define-fault-tree>
<model-data>
<define-basic-event name="fault-node__it_s__up_-1">
<label>node: it's &lt;up&gt; is faulty</label>
</define-basic-event>
<define-basic-event name="fault-node__it_s__up_">
<label>node__it_s__up_ is faulty</label>
</define-basic-event>
</model-data>
</opsa-mef>
)");
  const CompiledCatalog without = compile_text("behaviors: []\ntasks: [{task: A}]\n");
  EXPECT_EQ(open_psa_text(without, tree_of(without, 0)),
            head + "It is impossible without any fault.\n" + note +
                R"(<define-fault-tree name="A">
<label>A in )" + std::string(without.file) +
                R"(</label>
<define-gate name="task-A">
<label>A is lost</label>
<house-event name="always"/>
</define-gate>
<define-house-event name="always">
<constant value="true"/>
</define-house-event>
</define-fault-tree>
<model-data>
</model-data>
</opsa-mef>
)");
}

// With SCRAM -------------------------------------------------------------------------------------

bool has_scram() { return std::system("command -v scram >/dev/null 2>&1") == 0; }

/// How many cut sets of each size, from 1, SCRAM finds.
std::vector<std::size_t> scram_counts(const test::ScratchFolder& folder, const std::string& xml,
                                      std::size_t order) {
  folder.write("tree.xml", xml);
  const std::string command = fmt::format("scram --limit-order {} -o '{}' '{}'", order,
                                          folder / "report.xml", folder / "tree.xml");
  EXPECT_EQ(std::system(command.c_str()), 0) << xml;
  const std::string report = folder.read("report.xml");
  std::vector<std::size_t> counts(order);
  constexpr std::string_view product = "<product order=\"";
  for (std::size_t at = report.find(product); at != std::string::npos;
       at = report.find(product, at + 1)) {
    ++counts.at(std::stoul(report.substr(at + product.size())) - 1);
  }
  return counts;
}

/// The same that find_cut_sets() finds, by another way and another program.
TEST(OpenPsa, GivesScramTheSameCutSets) {
  if (!has_scram()) GTEST_SKIP() << "there is no scram";
  const test::ScratchFolder folder;
  std::size_t trees = 0;
  for (const char* const name : {"autoware", "quadrotor", "mobile-manipulator"}) {
    const CompiledCatalog catalog =
        compile_text(test::read_file(fmt::format("{}/catalogs/{}.yaml", CBC_SOURCE_DIR, name)));
    for (const TaskId task : catalog.task_ids) {
      if (catalog.tasks[task].start_on_request == 0) continue;
      CutSetOptions options;
      options.order = 3;
      std::vector<std::size_t> expected(options.order);
      for (const auto& set :
           find_cut_sets(catalog, task, ruled_out_by(catalog, {}), options).sets) {
        ++expected.at(set.size() - 1);
      }
      EXPECT_EQ(scram_counts(folder, open_psa_text(catalog, tree_of(catalog, task)), options.order),
                expected)
          << catalog.name_of_task(task);
      ++trees;
    }
  }
  EXPECT_GT(trees, 20U);
}

/// SCRAM checks the syntax, and that names are identifiers and distinct.
TEST(OpenPsa, IsValidForScramWhateverTheNames) {
  if (!has_scram()) GTEST_SKIP() << "there is no scram";
  const test::ScratchFolder folder;
  const CompiledCatalog catalog = compile_text(R"(behaviors:
- {behavior: a-b, task: "é\n-->"}
- {behavior: a.b, task: "é\n-->"}
- {behavior: A_B, task: "é\n-->"}
- {behavior: a_b, task: "é\n-->", requires: [{task: a_b}]}
- {behavior: "1", task: a_b, requires: [{task: A_B}]}
- {behavior: "é", task: A_B}
tasks: [{task: none}]
)");
  const std::string xml = open_psa_text(catalog, tree_of(catalog, task_id(catalog, "é\n-->")));
  EXPECT_EQ(scram_counts(folder, xml, 4), (std::vector<std::size_t>{0, 0, 0, 3}));
  // Of an event that always happens, SCRAM reports one product without events, of order 1.
  const std::string impossible = open_psa_text(catalog, tree_of(catalog, task_id(catalog, "none")));
  EXPECT_EQ(scram_counts(folder, impossible, 2), (std::vector<std::size_t>{1, 0}));
}

}  // namespace
}  // namespace cbc::fault_tree_test
