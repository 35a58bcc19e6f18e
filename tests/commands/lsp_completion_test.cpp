// What may be written at a place, and what there is to say of it.
#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "cbc/event.h"
#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/files/recognition.h"
#include "core/property/property_reader.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "lsp/language/completion.h"
#include "lsp/language/hover.h"
#include "runtime/coordinator/record.h"
#include "support/edited_files.h"

namespace cbc::lsp_completion_test {
namespace {

using cli::FileKind;
using lsp::Completion;
using test::context_at_mark;

std::vector<Completion> completions(const std::string& marked, FileKind kind,
                                    const Catalog* catalog = &test::robot()) {
  return lsp::complete(context_at_mark(marked), kind, catalog);
}

/// What would be inserted, but for snippets.
std::string offered(const std::string& marked, FileKind kind,
                    const Catalog* catalog = &test::robot()) {
  std::string text;
  for (const Completion& completion : completions(marked, kind, catalog)) {
    if (completion.is_snippet) continue;
    text += (text.empty() ? "" : "; ") + completion.insert;
  }
  return text;
}

/// The labels of the snippets.
std::set<std::string> snippets(const std::string& marked, FileKind kind) {
  std::set<std::string> labels;
  for (const Completion& completion : completions(marked, kind)) {
    if (completion.is_snippet) labels.insert(completion.label);
  }
  return labels;
}

constexpr auto catalog_kind = FileKind::catalog;
constexpr auto script_kind = FileKind::script;
constexpr auto property_kind = FileKind::properties;

TEST(LspCompletion, OfKeys) {
  EXPECT_EQ(offered("|", catalog_kind),
            "default_values: ; behaviors: ; tasks: ; exclusivity_constraints: ; situation: ");
  EXPECT_EQ(offered("tasks:\n- {task: A}\n|\nbehaviors: []", catalog_kind),
            "default_values: ; exclusivity_constraints: ; situation: ");
  EXPECT_EQ(offered("behaviors:\n- {behavior: A, task: B, |}", catalog_kind),
            "package: ; requires: ; timeout: ; situation: ; suitability: ; retry: ");
  EXPECT_EQ(offered("behaviors:\n- {behavior: A, ta|: B}", catalog_kind),
            "package; task; tasks; requires; timeout; situation; suitability; retry");
  EXPECT_EQ(offered("behaviors:\n- beh|", catalog_kind),
            "behavior: ; package: ; task: ; tasks: ; requires: ; timeout: ; situation: ; "
            "suitability: ; retry: ");
  EXPECT_EQ(
      offered("{\"behaviors\": [{\"behavior\": \"A\", \"requires\": [{\"|\"}]}]}", catalog_kind),
      "\"task\": ; \"minimum_performance\": ");
  EXPECT_EQ(offered("- {start: A, |}", script_kind),
            "at: ; wait: ; priority: ; parameters: ; cause: ");
  EXPECT_EQ(offered("events:\n- expect: {|}", script_kind),
            "outcome: ; running: ; stopped: ; active: ; active_includes: ; suspended: ; failed: ");
  EXPECT_EQ(offered("- expect:\n    |", script_kind),
            "outcome: ; running: ; stopped: ; active: ; active_includes: ; suspended: ; failed: ");
  EXPECT_EQ(offered("- expect:\n    out|", script_kind),
            "outcome: ; running: ; stopped: ; active: ; active_includes: ; suspended: ; failed: ");
  EXPECT_EQ(
      offered("properties:\n- {never: {not: {any: [{|}]}}}", property_kind),
      "running: ; stopped: ; active: ; active_includes: ; faulty: ; available: ; requested: ; "
      "suspended: ; failed: ; situation: ; not: ; any: ; all: ");
  EXPECT_EQ(offered("assume: {faults: {most: 1, |}}", property_kind), "of: ; except: ");
  EXPECT_EQ(offered("|", FileKind::settings),
            "error: ; warn: ; note: ; allow: ; strict: ; never_together: ");
  EXPECT_EQ(offered("|", FileKind::other), "");
  EXPECT_EQ(offered("a: b # |", catalog_kind), "");
}

TEST(LspCompletion, ExplainsKeys) {
  const auto found = completions("behaviors:\n- {|}", catalog_kind);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, Completion::Kind::key);
  EXPECT_EQ(found[0].label, "behavior");
  EXPECT_EQ(found[0].detail, "required");
  EXPECT_TRUE(found[0].documentation.starts_with("The name of the behavior"))
      << found[0].documentation;
  EXPECT_EQ(found[1].detail, "");
}

TEST(LspCompletion, OfWords) {
  EXPECT_EQ(offered("tasks:\n- {task: A, execution_goal: |}", catalog_kind),
            "achieve_goal; keep_running");
  EXPECT_EQ(offered("tasks:\n- {task: A, start_on_request: |}", catalog_kind), "true; false");
  EXPECT_EQ(offered("{\"tasks\": [{\"task\": \"A\", \"execution_goal\": |}]}", catalog_kind),
            "\"achieve_goal\"; \"keep_running\"");
  EXPECT_EQ(offered("{\"tasks\": [{\"task\": \"A\", \"start_on_request\": |}]}", catalog_kind),
            "true; false");
  EXPECT_EQ(
      offered("- {finish: A, cause: |}", script_kind),
      "goal_achieved; time_out; wrong_progress; situation_change; process_failure; interrupted");
  EXPECT_EQ(offered("- expect: {outcome: |}", script_kind), "accepted; rejected; unchanged");
  EXPECT_EQ(offered("properties:\n- {keeps_running: A, by: [|]}", property_kind),
            "start; stop; successes; failures; fault; repair; situation; queue");
  EXPECT_EQ(offered("strict: |", FileKind::settings), "true; false");
  const std::string rules = offered("allow: [|]", FileKind::settings);
  EXPECT_EQ(std::count(rules.begin(), rules.end(), ';') + 1,
            static_cast<std::ptrdiff_t>(all_rules().size()));
}

TEST(LspCompletion, OfNames) {
  const std::string tasks = "FLY; SEE; LAND; \"a: b\"";
  const std::string behaviors = "FLY_FAST; FLY_SLOWLY; LOOK; \"yes\"";
  const auto expect = [](const std::string& marked, FileKind kind, const std::string& expected) {
    std::vector<std::string> names;
    for (const Completion& completion : completions(marked, kind)) {
      if (!completion.is_snippet) names.push_back(completion.insert);
    }
    std::sort(names.begin(), names.end());
    std::vector<std::string> wanted;
    for (std::size_t begin = 0; begin < expected.size();) {
      const std::size_t end = std::min(expected.find("; ", begin), expected.size());
      wanted.push_back(expected.substr(begin, end - begin));
      begin = end + 2;
    }
    std::sort(wanted.begin(), wanted.end());
    EXPECT_EQ(names, wanted) << marked;
  };
  expect("behaviors:\n- {behavior: X, task: |}", catalog_kind, tasks);
  expect("behaviors:\n- {behavior: |, task: A}", catalog_kind, "");
  expect("behaviors:\n- behavior: A\n  requires:\n  - task: F|\n", catalog_kind, tasks);
  expect("behaviors:\n- {behavior: A, tasks: [{task: |}]}", catalog_kind, tasks);
  expect("behaviors:\n- {behavior: A, situation: {|}}", catalog_kind, "LIGHT: ; WIND: ");
  expect("behaviors:\n- {behavior: A, situation: {LIGHT: |}}", catalog_kind, "day; dusk; night");
  expect("behaviors:\n- {behavior: A, situation: {LIGHT: [day, |]}}", catalog_kind,
         "day; dusk; night");
  expect("behaviors:\n- {behavior: A, situation: {WIND: |}}", catalog_kind, "true; false");
  expect("tasks:\n- task: |", catalog_kind, "\"a: b\"");
  expect("exclusivity_constraints:\n- {mutually_exclusive: [FLY, |", catalog_kind, tasks);
  expect("situation:\n- variable: |", catalog_kind, "");
  expect("- start: |", script_kind, tasks);
  expect("events:\n- {stop: |", script_kind, tasks);
  expect("- finish: |", script_kind, behaviors);
  expect("- finish: {task: |}", script_kind, tasks);
  expect("- fault: |", script_kind, behaviors);
  expect("- repair: |", script_kind, behaviors);
  expect("- {situation: {|}}", script_kind,
         "LIGHT: ; WIND: ; FLY_FAST: ; FLY_SLOWLY: ; LOOK: ; \"yes\": ");
  expect("- {situation: {LIGHT: |}}", script_kind, "day; dusk; night");
  expect("situation: {LOOK: |}", script_kind, "true; false");
  expect("- {expect: {running: {|}}}", script_kind, "FLY: ; SEE: ; \"a: b\": ; LAND: ");
  expect("- {expect: {running: {FLY: |}}}", script_kind, "any; FLY_FAST; FLY_SLOWLY");
  expect("- {expect: {running: {FLY: [FLY_FAST, |]}}}", script_kind, "FLY_FAST; FLY_SLOWLY");
  expect("- {expect: {stopped: [|]}}", script_kind, tasks);
  expect("- {expect: {active: [|]}}", script_kind, behaviors);
  expect("assume: {start: [|]}", property_kind, tasks);
  expect("assume: {start: {|}}", property_kind, "FLY: ; SEE: ; \"a: b\": ; LAND: ");
  expect("assume: {start: |}", property_kind, "all");
  expect("assume: {together: [[|]]}", property_kind, "LIGHT; WIND");
  expect("initially: {LIGHT: |}", property_kind, "day; dusk; night");
  expect("properties:\n- can_start: |", property_kind, tasks);
  expect("properties:\n- always: {faulty: |}", property_kind, "none");
  expect("properties:\n- always: {faulty: [|]}", property_kind, behaviors);
  expect("properties:\n- always: {not: {running: {SEE: |}}}", property_kind, "any; LOOK");
  expect("properties:\n- always: {all: [{situation: {LIGHT: |}}]}", property_kind,
         "day; dusk; night");
  expect("never_together: [[|]]", FileKind::settings, tasks);
  EXPECT_EQ(offered("- start: |", script_kind, nullptr), "");
  EXPECT_EQ(offered("[{\"start\": |}]", script_kind), "\"FLY\"; \"SEE\"; \"LAND\"; \"a: b\"");
}

TEST(LspCompletion, OfParameters) {
  EXPECT_EQ(offered("- {start: FLY, parameters: {|}}", script_kind), "speed: ; side: ; hard: ");
  EXPECT_EQ(offered("- start: FLY\n  parameters:\n    side: left\n    |", script_kind),
            "speed: ; hard: ");
  EXPECT_EQ(offered("- {start: FLY, parameters: {side: |}}", script_kind), "left; right");
  EXPECT_EQ(offered("- {start: FLY, parameters: {hard: |}}", script_kind), "true; false");
  EXPECT_EQ(offered("- {start: FLY, parameters: {speed: |}}", script_kind), "");
  EXPECT_EQ(offered("- {start: SEE, parameters: {|}}", script_kind), "");
  EXPECT_EQ(completions("- {start: FLY, parameters: {|}}", script_kind)[0].detail, "[0, 30]");
}

TEST(LspCompletion, NamesAreInsertedAsThey) {
  Diagnostics ignored;
  for (const char* const name :
       {"A",  "a b", "true", "12", "~",  "null", "a: b",     "a #b", "[x]",  "a,b", "- a", "*a",
        "&a", "@a",  "'a'",  "\"", "\\", "<<",   "\xC3\xA4", "\n",   "a\tb", "%a",  "?",   "-"}) {
    Catalog catalog;
    catalog.tasks.emplace_back().name = name;
    for (const std::string text :
         {"- {start: |}\n", "- start: |\n", "- {\"expect\": {stopped: [|]}}\n"}) {
      const auto found = completions(text, script_kind, &catalog);
      ASSERT_FALSE(found.empty());
      std::string written = text;
      written.replace(written.find('|'), 1, found[0].insert);
      const auto document = yaml::parse(written, "", ignored);
      ASSERT_NE(document, nullptr) << written;
      const auto& nodes = document->nodes();
      EXPECT_TRUE(std::any_of(nodes.begin(), nodes.end(), [name](const yaml::Node& node) {
        return node.kind == yaml::Kind::scalar && node.text == name;
      })) << written;
    }
  }
}

TEST(LspCompletion, OffersSnippetsWhereEntriesStand) {
  const std::set<std::string> of_behaviors = {"behavior", "behavior that requires a task"};
  EXPECT_EQ(snippets("behaviors:\n- |", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n- be|", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n|", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n  |", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n- {behavior: A}\n|", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n- {behavior: A}\nbe|", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors: [|]", catalog_kind), of_behaviors);
  EXPECT_EQ(snippets("behaviors:\n- {|}", catalog_kind), std::set<std::string>());
  EXPECT_EQ(snippets("- {start: A}\n|", script_kind), snippets("events:\n- |", script_kind));
  EXPECT_EQ(snippets("- |", script_kind), snippets("events:\n- |", script_kind));
  EXPECT_EQ(snippets("- finish: |", script_kind), std::set<std::string>{"task: TASK"});
}

/// Completed as an editor does if nobody changes the placeholders.
std::string without_placeholders(std::string text) {
  for (std::size_t begin = 0; (begin = text.find("${", begin)) != std::string::npos;) {
    text.erase(text.find('}', begin), 1);
    text.erase(begin, text.find(':', begin) + 1 - begin);
  }
  return text;
}

TEST(LspCompletion, SnippetsAreValid) {
  const std::vector<std::pair<std::string, FileKind>> lists = {
      {"behaviors:\n", catalog_kind},
      {"behaviors: [{behavior: A, task: B}]\ntasks:\n", catalog_kind},
      {"behaviors: [{behavior: A, task: B}]\nexclusivity_constraints:\n", catalog_kind},
      {"behaviors: [{behavior: A, task: B}]\nsituation:\n", catalog_kind},
      {"behaviors:\n- behavior: A\n  task: B\n  requires:\n  ", catalog_kind},
      {"behaviors:\n- behavior: A\n  tasks:\n  ", catalog_kind},
      {"behaviors: [{behavior: A, task: B}]\ntasks:\n- task: B\n  parameters:\n  ", catalog_kind},
      {"events:\n", script_kind},
      {"properties:\n", property_kind}};
  Diagnostics ignored;
  const Catalog catalog = *read_catalog(
      "behaviors:\n- {behavior: BEHAVIOR, task: TASK}\n- {behavior: B, task: OTHER}\nsituation: "
      "[{variable: NAME}]\n",
      "", ignored);
  const CompiledCatalog compiled = compile(catalog);
  std::map<FileKind, std::size_t> checked;
  std::set<std::string> labels;
  for (const auto& [list, kind] : lists) {
    for (const Completion& completion : completions(list + "|\n", kind)) {
      if (!completion.is_snippet || !completion.insert.starts_with("- ")) continue;
      ++checked[kind];
      labels.insert(completion.label);
      const std::string text = list + without_placeholders(completion.insert) + "\n";
      Diagnostics diagnostics;
      const auto document = yaml::parse(text, "", diagnostics);
      ASSERT_NE(document, nullptr) << text;
      if (kind == catalog_kind) {
        EXPECT_TRUE(understand_catalog(*document, diagnostics).has_all_behaviors) << text;
      } else if (kind == script_kind) {
        EXPECT_TRUE(read_script(*document, compiled, Severity::error, diagnostics)) << text;
      } else {
        EXPECT_TRUE(read_properties(*document, compiled, diagnostics)) << text;
      }
      for (const Diagnostic& finding : diagnostics.all()) {
        const bool is_known = finding.rule == rule::undefined_task.name;
        EXPECT_TRUE(is_known || finding.severity != Severity::error) << text << finding.message;
      }
    }
  }
  EXPECT_GE(checked[catalog_kind], 11U);
  for (const VerbForm& verb : scripted_verbs) {
    EXPECT_TRUE(labels.contains(std::string(verb.name)));
  }
  EXPECT_TRUE(labels.contains("expect"));
  for (const std::string_view kind : property_kinds)
    EXPECT_TRUE(labels.contains(std::string(kind)));
}

TEST(LspCompletion, SnippetsOfJsonAreJson) {
  const auto found =
      completions(R"({"behaviors": [{"behavior": "A", "task": "B"}, |]})", catalog_kind);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].insert,
            R"({"behavior": "${1:NAME}", "task": "${2:TASK}", "suitability": ${3:100}})");
}

std::string hover(const std::string& marked, FileKind kind,
                  const Catalog* catalog = &test::robot()) {
  return lsp::describe(context_at_mark(marked), kind, catalog);
}

TEST(LspHover, OfNames) {
  EXPECT_EQ(hover("- start: F|LY", script_kind),
            "task **FLY**\n\n"
            "- performed by: FLY_FAST (90 %), FLY_SLOWLY (60 %)\n"
            "- excludes: LAND\n"
            "- timeout: 30 s\n"
            "- minimum performance: 20 %\n"
            "- parameters: speed \\[0, 30\\], side \\[left, right\\], hard boolean\n");
  EXPECT_EQ(hover("tasks:\n- task: |SEE", catalog_kind),
            "task **SEE**\n\n"
            "- performed by: LOOK (100 %)\n"
            "- required by: FLY_FAST (at least 50 %)\n"
            "- also starts when a behavior requires it\n"
            "- keeps running\n");
  EXPECT_EQ(hover("- fault: FLY_FAST|", script_kind),
            "behavior **FLY_FAST**\n\n"
            "- performs: FLY (90 %)\n"
            "- requires: SEE (at least 50 %)\n"
            "- fits in: LIGHT: day, dusk, not WIND\n"
            "- timeout: 4.5 s\n"
            "- package: wings\n");
  EXPECT_EQ(hover("situation: {L|IGHT: day}", script_kind),
            "situation variable **LIGHT**\n\n"
            "- values: day, dusk, night\n"
            "- at first: day\n"
            "- behaviors that depend on it: FLY_FAST (LIGHT: day, dusk)\n");
  EXPECT_EQ(hover("situation: {LIGHT: d|ay}", script_kind),
            hover("situation: {L|IGHT: day}", script_kind));
  EXPECT_EQ(hover("- start: F|L", script_kind), "the catalog has no task FL\n");
  EXPECT_EQ(hover("- start: F|LY", script_kind, nullptr), "");
}

TEST(LspHover, OfKeysAndWords) {
  const std::string priority = hover("- {start: A, prio|rity: 1}", script_kind);
  EXPECT_TRUE(priority.starts_with("key **priority**\n\nThe priority of a start")) << priority;
  EXPECT_EQ(hover("- {start: A, priority: 1|}", script_kind), priority);
  EXPECT_TRUE(hover("tasks:\n- {task: A, cat|egory: recurrent}", catalog_kind)
                  .starts_with("key **category**\n\nAn older name of execution"));
  EXPECT_EQ(hover("- {start: A, foo|: 1}", script_kind), "");
  EXPECT_EQ(hover("a: # com|ment", script_kind), "");
  EXPECT_EQ(hover("allow: [dead-ta|sk]", FileKind::settings), lsp::describe_rule("dead-task"));
}

TEST(LspHover, OfRules) {
  for (const Rule& rule : all_rules()) {
    const std::string text = lsp::describe_rule(rule.name);
    EXPECT_NE(text.find("```yaml\n" + std::string(rule.example) + "```"), std::string::npos);
    EXPECT_NE(text.find("**" + std::string(rule.name) + "**"), std::string::npos);
  }
  EXPECT_EQ(lsp::describe_rule("no-such-rule"), "");
}

TEST(LspHover, EscapesMarkdown) {
  Catalog catalog;
  catalog.tasks.emplace_back().name = "<b>*a*\n# b";
  const std::string text = hover(R"(- start: "<b>*a*\n# |b")", script_kind, &catalog);
  EXPECT_EQ(text.find("<b>"), std::string::npos);
  EXPECT_EQ(text.find("\n#"), std::string::npos);
  EXPECT_NE(text.find("\\*a\\*"), std::string::npos) << text;
}

}  // namespace
}  // namespace cbc::lsp_completion_test
