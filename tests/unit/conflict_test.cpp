// The effort that a conflict may take. That it is right is compared with brute force in
// tests/property.

#include <string>

#include <gtest/gtest.h>

#include "core/report/run_text.h"
#include "core/script/runner.h"
#include "core/support/system.h"
#include "unit/compiled_fixture.h"

namespace cbc::conflict_test {
namespace {

/// What a person reads of a mission in which X is rejected, as it requires C0, which requires C1,
/// and so on; the last of `length` excludes P, which is protected.
std::string report_of_chain(int length) {
  std::string text = "behaviors:\n- {behavior: p, task: P}\n";
  for (int link = -1; link < length; ++link) {
    const std::string task = link < 0 ? "X" : "C" + std::to_string(link);
    text += "- {behavior: b" + task + ", task: " + task;
    if (link + 1 < length) text += ", requires: [{task: C" + std::to_string(link + 1) + "}]";
    text += "}\n";
  }
  text += "exclusivity_constraints:\n- mutually_exclusive: [P, C" + std::to_string(length - 1) +
          "]\ndefault_values: {tasks: {start_on_request: false}}\n";
  const CompiledCatalog catalog = test::compile_text(text);
  Script script;
  script.file = "script.yaml";
  for (const char* const task : {"P", "X"}) {
    Step step;
    step.verb = Verb::start;
    step.subject = *catalog.find_task(task);
    step.priority = script.steps.empty() ? 3 : 1;
    script.steps.push_back(step);
  }
  MemoryFile memory;
  TextReport report(plain_style(), memory.stream());
  report.begin_run(catalog, script);
  (void)run_script(catalog, script, {}, report, {.rejections = true});
  return std::string(memory.text());
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++found;
  }
  return found;
}

TEST(Conflict, MayBeLong) {
  const std::string report = report_of_chain(300);
  EXPECT_EQ(count(report, " requires "), 300U);
  EXPECT_EQ(count(report, ", which runs with priority 3, higher than 1"), 1U);
}

TEST(Conflict, IsGivenUpWhereItTakesTooLong) {
  const std::string report = report_of_chain(5000);
  EXPECT_EQ(count(report, " requires "), 0U);
  EXPECT_NE(report.find("start X, priority 1: rejected\n           no consistent set of behaviors; "
                        "finding the reasons would have taken too long\n"),
            std::string::npos);
}

}  // namespace
}  // namespace cbc::conflict_test
