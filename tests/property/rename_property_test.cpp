// Random catalogs and scripts in which something gets another name: the texts must be those that
// are written with this name from the start, byte by byte, and the script must do the same as
// before. CBC_SEED and CBC_PROPERTY_CASES are as in property_test.cpp.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/catalog/renaming.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "demand.h"
#include "generator.h"
#include "random_cases.h"
#include "rename/engine/proof.h"
#include "subject.h"
#include "support/renamed.h"
#include "yaml_text.h"

namespace cbc::oracle::rename_property_test {
namespace {

constexpr std::uint64_t default_cases = 500;
constexpr const char* new_name = "quite_another";

/// Something that has a name.
struct Choice {
  Renaming renaming;
  std::string* name = nullptr;  ///< in the catalog
};

Choice choose(Catalog& catalog, Random& random) {
  const std::size_t task = random.below(catalog.tasks.size());
  const std::size_t behavior = random.below(catalog.behaviors.size());
  // Tasks and behaviors may have the same names, and mean different things.
  const std::string& shared = catalog.tasks[task].name;
  const auto has_shared = [&shared](const auto& thing) { return thing.name == shared; };
  const bool is_taken =
      std::any_of(catalog.behaviors.begin(), catalog.behaviors.end(), has_shared) ||
      std::any_of(catalog.variables.begin(), catalog.variables.end(), has_shared);
  if (!is_taken && random.percent(50)) catalog.behaviors[behavior].name = shared;
  Choice choice;
  const std::size_t kind = random.below(catalog.variables.empty() ? 2 : 3);
  if (kind == 0) {
    choice = {{NameKind::task, {}, new_name}, &catalog.tasks[task].name};
  } else if (kind == 1) {
    choice = {{NameKind::behavior, {}, new_name}, &catalog.behaviors[behavior].name};
  } else {
    const std::size_t variable = random.below(catalog.variables.size());
    choice = {{NameKind::variable, {}, new_name}, &catalog.variables[variable].name};
  }
  choice.renaming.old_name = *choice.name;
  return choice;
}

struct Texts {
  std::string catalog;
  std::string script;
};

/// In the same forms for the same seed.
Texts write(const Case& sample, std::uint64_t seed) {
  Random forms(~seed);
  Texts texts;
  texts.catalog = catalog_yaml(sample.catalog, forms);
  texts.script = script_yaml(sample.catalog, sample.script, forms);
  return texts;
}

struct ReadCatalog {
  std::unique_ptr<const yaml::Document> document;
  CatalogReading reading;
  CompiledCatalog compiled;
};

ReadCatalog read(const std::string& text) {
  Diagnostics diagnostics;
  ReadCatalog result;
  result.document = yaml::parse(text, "catalog.yaml", diagnostics);
  demand(result.document != nullptr, "the catalog is no YAML");
  result.reading = understand_catalog(*result.document, diagnostics);
  demand(diagnostics.count(Severity::error) == 0, "the catalog is refused");
  result.compiled = compile(result.reading.catalog);
  return result;
}

std::string rename_script(const std::string& text, const CompiledCatalog& catalog,
                          const Renaming& renaming) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "script.yaml", diagnostics);
  demand(document != nullptr, "the script is no YAML");
  std::vector<NamePlace> names;
  demand(
      read_script(*document, catalog, Severity::warning, diagnostics, nullptr, &names).has_value(),
      "the script is refused");
  const RenamedText renamed = rename_in(text, *document, names, renaming);
  demand(!renamed.obstacle, "the script cannot be changed");
  return renamed.text;
}

/// What comes of a script, without sentences.
std::string run(const std::string& catalog, const std::string& script) {
  nlohmann::ordered_json events = run_subject(catalog, script);
  test::drop_messages(events);
  return events.dump();
}

void check(std::uint64_t seed, Results& results) {
  Random random(seed);
  Case sample = generate_case(random);
  if (sample.catalog.behaviors.empty()) return;
  const Choice choice = choose(sample.catalog, random);
  const Texts before = write(sample, seed);
  *choice.name = new_name;
  const Texts wanted = write(sample, seed);

  const ReadCatalog old_catalog = read(before.catalog);
  const RenamedText catalog =
      rename_in(before.catalog, *old_catalog.document, old_catalog.reading.names, choice.renaming);
  demand(!catalog.obstacle, "the catalog cannot be changed");
  demand(catalog.places > 0, "nothing is changed");
  demand(catalog.text == wanted.catalog, "another text:\n" + catalog.text);
  const std::string script = rename_script(before.script, old_catalog.compiled, choice.renaming);
  demand(script == wanted.script, "another text:\n" + script);

  const ReadCatalog new_catalog = read(catalog.text);
  demand(same_meaning(with_new_name(old_catalog.reading.catalog, choice.renaming),
                      new_catalog.reading.catalog),
         "another meaning");
  Budget budget;
  budget.max_states = 200;
  const CatalogComparison comparison =
      compare_renamed(old_catalog.compiled, new_catalog.compiled, choice.renaming, budget, 1);
  demand(comparison.result != Verdict::Result::violated, "decided differently");
  demand(test::with_name(run(catalog.text, script), new_name, choice.renaming.old_name) ==
             run(before.catalog, before.script),
         "the script does something else");

  Statistics& statistics = results.statistics;
  statistics.count("renamed: " + std::string(name_of(choice.renaming.kind)));
  if (comparison.result == Verdict::Result::proved) statistics.count("proved");
  if (script != before.script) statistics.count("the script has the name");
}

void run_case(std::uint64_t seed, Results& results) {
  try {
    check(seed, results);
  } catch (const std::exception& fault) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n" + fault.what()});
  }
}

const LowerBound lower_bounds[] = {{"renamed: task", 200},
                                   {"renamed: behavior", 200},
                                   {"renamed: variable", 30},
                                   {"proved", 200},
                                   {"the script has the name", 200}};

TEST(Renaming, OfRandomCases) { run_random_cases(default_cases, run_case, lower_bounds); }

}  // namespace
}  // namespace cbc::oracle::rename_property_test
