#include "script/script_names.h"

#include <string>

#include <gtest/gtest.h>

#include "unit/compiled_fixture.h"

namespace cbc {
namespace {

std::string describe(const ScriptNames& names) {
  std::string text;
  for (std::size_t task = 0; task < names.tasks.size(); ++task) {
    text += std::string(names.tasks[task]) + "(";
    for (const Parameter& parameter : names.parameters.at(task)) text += parameter.name + ",";
    text += ") ";
  }
  for (std::size_t behavior = 0; behavior < names.behaviors.size(); ++behavior) {
    text += std::string(names.behaviors[behavior]) + ":";
    for (const std::uint32_t task : names.performs.at(behavior)) text += std::to_string(task) + ",";
    text += " ";
  }
  return text;
}

TEST(ScriptNames, AreInCatalogOrder) {
  const CompiledCatalog catalog = test::compile_text(R"(
tasks:
- {task: A, parameters: [{parameter: p}, {parameter: q}]}
- {task: B}
- {task: C, parameters: [{parameter: r}]}
- {task: D}
behaviors:
- {behavior: a, tasks: [{task: D}, {task: A}]}
- {behavior: b, task: B}
- {behavior: c, task: C, requires: [{task: A}]}
- {behavior: d, tasks: [{task: C}, {task: A, suitability: 10}, {task: D}]}
)");
  EXPECT_EQ(describe(names_of(catalog)), "A(p,q,) B() C(r,) D() a:0,3, b:1, c:2, d:0,2,3, ");
}

TEST(ScriptNames, OfAnEmptyCatalog) {
  EXPECT_EQ(describe(names_of(test::compile_text("behaviors: []"))), "");
}

}  // namespace
}  // namespace cbc
