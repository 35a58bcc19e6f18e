// Prints catalogs for check_inputs.js, one on a line: {"kind", "text", "rules", "findings"}. Each
// has one mistake of a kind, which breaks `rules`; "findings" is what lint reports of the text,
// each a rule and its severity. A good catalog is of kind "good".
//
// An argument N sets the number of catalogs of each kind.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/check/check.h"
#include "core/yaml/document.h"
#include "property/lint_catalogs.h"
#include "property/lint_mutations.h"
#include "runtime/base/text.h"

namespace {

using namespace cbc;
using namespace cbc::mutation;

nlohmann::json lint(const std::string& text) {
  Diagnostics diagnostics;
  if (const auto document = yaml::parse(text, "catalog.yaml", diagnostics)) {
    static_cast<void>(lint_catalog(*document, {}, diagnostics));
  }
  nlohmann::json findings = nlohmann::json::array();
  for (const Diagnostic& finding : diagnostics.all()) {
    findings.push_back({finding.rule, name_of(finding.severity)});
  }
  return findings;
}

void print(std::string_view kind, const std::string& text, const nlohmann::json& rules) {
  const nlohmann::json line{
      {"kind", kind}, {"text", text}, {"rules", rules}, {"findings", lint(text)}};
  fmt::print("{}\n", line.dump());
}

/// A random catalog with the mistake, if there is a place for it.
void print_mutation(const MistakeKind& kind, Random& random) {
  const std::string text = random_catalog_text(random);
  const auto outline = CatalogOutline::read(Lines(text));
  if (outline == nullptr) return;
  const auto mutation = kind.apply(*outline, random);
  if (!mutation || utf8::find_invalid(mutation->text)) return;  // JSON is UTF-8
  nlohmann::json rules = nlohmann::json::array();
  for (const Expected& expected : mutation->expected) rules.push_back(expected.rule);
  print(kind.name, mutation->text, rules);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 20;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    Random random(seed);
    print("good", random_catalog_text(random), nlohmann::json::array());
    for (const auto& kinds : {syntax_mistakes(), key_mistakes(), value_mistakes(), name_mistakes(),
                              meaning_mistakes()}) {
      for (const MistakeKind& kind : kinds) print_mutation(kind, random);
    }
  }
}
