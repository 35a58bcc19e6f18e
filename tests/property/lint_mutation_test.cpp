// Single mistakes, put at random into good catalogs: lint must find each of them, where it was
// made, and no other error. CBC_SEED sets the seed of the first case, CBC_PROPERTY_CASES their
// number; CBC_SEED=<that of a failure> CBC_PROPERTY_CASES=1 repeats it alone. CBC_SHARED is the
// folder above the published catalogs, if they are at hand.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "block_text.h"
#include "catalog_outline.h"
#include "core/check/check.h"
#include "core/diagnostic/rules.h"
#include "core/yaml/document.h"
#include "environment.h"
#include "lint_catalogs.h"
#include "lint_mutations.h"
#include "support/catalog_files.h"
#include "support/read_file.h"
#include "support/shared_folder.h"

namespace cbc::mutation::lint_mutation_test {
namespace {

constexpr std::uint64_t default_seed = 1;
constexpr std::uint64_t default_mutations = 5000;
constexpr std::size_t failures_shown = 5;
/// Fewer cases say nothing about how often a kind of mistake was made.
constexpr std::uint64_t cases_for_statistics = 2000;

std::vector<Diagnostic> lint(const std::string& text) {
  Diagnostics diagnostics;
  if (const auto document = yaml::parse(text, "catalog.yaml", diagnostics)) {
    static_cast<void>(lint_catalog(*document, {}, diagnostics));
  }
  diagnostics.sort();
  return diagnostics.release();
}

std::string show(const Diagnostic& finding) {
  return std::to_string(finding.range.begin.line) + ":" +
         std::to_string(finding.range.begin.column) + " " + std::string(name_of(finding.severity)) +
         " " + std::string(finding.rule) + ": " + finding.message + "\n";
}

std::string show(const Expected& expected) {
  std::string text;
  for (const std::size_t line : expected.lines) {
    text += (text.empty() ? "" : " or ") + std::to_string(line);
  }
  text += ":" + (expected.column ? std::to_string(*expected.column) : "*") + " " +
          std::string(expected.rule);
  return text + (expected.says.empty() ? "" : ": ..." + expected.says + "...");
}

bool fits(const Diagnostic& finding, const Expected& expected) {
  const Position& begin = finding.range.begin;
  return finding.rule == expected.rule && expected.lines.contains(begin.line) &&
         (!expected.column || *expected.column == begin.column) &&
         finding.message.find(expected.says) != std::string::npos;
}

/// Rule and message of a finding, but for what the message says about a value that may be mutated,
/// or only of a catalog without errors.
std::pair<std::string, std::string> identity(const Diagnostic& finding) {
  const std::size_t end =
      std::min(finding.message.find(": write "), finding.message.find(": request "));
  return {std::string(finding.rule), finding.message.substr(0, end)};
}

/// A valid catalog and the findings that lint has about it.
struct Base {
  std::string name;
  std::unique_ptr<CatalogOutline> outline;
  std::set<std::pair<std::string, std::string>> findings;  ///< their identities
  std::string errors;
};

Base make_base(const std::string& name, const std::string& text) {
  Base base;
  base.name = name;
  base.outline = CatalogOutline::read(Lines(text));
  for (const Diagnostic& finding : lint(text)) {
    base.findings.insert(identity(finding));
    if (finding.severity == Severity::error) base.errors += show(finding);
  }
  return base;
}

/// The catalogs of the project, and the published ones.
std::vector<Base> file_bases() {
  std::vector<Base> bases;
  const std::filesystem::path source(CBC_SOURCE_DIR);
  for (const char* name : {"quadrotor.yaml", "mobile-manipulator.yaml"}) {
    bases.push_back(make_base(name, test::read_file(source / "catalogs" / name)));
    EXPECT_EQ(bases.back().errors, "") << name;
    EXPECT_NE(bases.back().outline, nullptr) << name;
  }
  const std::filesystem::path folder = test::shared_catalogs();
  if (!std::filesystem::is_directory(folder)) {
    std::cout << "Skipped: the published catalogs; there is no " << folder << "\n";
    return bases;
  }
  for (const std::filesystem::path& path : test::catalog_files(folder)) {
    Base base = make_base(path.filename().string(), test::read_file(path));
    if (!base.errors.empty() || base.outline == nullptr) {
      std::cout << "Skipped: " << base.name
                << (base.errors.empty() ? ", another style\n" : ", which has errors\n");
    } else {
      bases.push_back(std::move(base));
    }
  }
  return bases;
}

/// What is wrong with the findings about a mutated catalog; empty if nothing is.
std::string check(const Base& base, const Mutation& mutation,
                  const std::vector<Diagnostic>& findings) {
  std::string wrong;
  std::size_t errors_expected = 0;
  for (const Expected& expected : mutation.expected) {
    const Rule* rule = find_rule(expected.rule);
    if (rule == nullptr) return "there is no rule " + std::string(expected.rule) + "\n";
    // A key that is probably another one is an error.
    const bool is_near = rule->name == rule::unknown_key.name &&
                         expected.says.find("did you mean") != std::string::npos;
    if (rule->severity == Severity::error || is_near) ++errors_expected;
    const bool is_found =
        std::any_of(findings.begin(), findings.end(),
                    [&](const Diagnostic& finding) { return fits(finding, expected); });
    if (!is_found) wrong += "not found: " + show(expected) + "\n";
  }
  const auto errors = static_cast<std::size_t>(
      std::count_if(findings.begin(), findings.end(),
                    [](const Diagnostic& finding) { return finding.severity == Severity::error; }));
  if (errors != errors_expected) {
    wrong += std::to_string(errors) + " errors, not " + std::to_string(errors_expected) + "\n";
  }
  for (const Diagnostic& finding : findings) {
    const bool is_expected =
        std::any_of(mutation.expected.begin(), mutation.expected.end(),
                    [&](const Expected& expected) { return fits(finding, expected); });
    // In a catalog with errors it is not known what is dead, and needs no request; of tasks that
    // conflict a pair with an error is not named, and so another one may be.
    const bool may_be_new = errors > 0 && (finding.rule == rule::requires_on_request ||
                                           finding.rule == rule::conflicting_requirements);
    // These depend on all of a catalog: what starts by other means, what excludes what.
    const bool is_of_the_whole =
        finding.rule == rule::never_started || finding.rule == rule::blocked_reactive;
    if (!is_expected && !may_be_new && !is_of_the_whole && !mutation.also.contains(finding.rule) &&
        !base.findings.contains(identity(finding))) {
      wrong += "follows from nothing: " + show(finding);
    }
  }
  return wrong;
}

/// What the mistake has changed, with the numbers of the lines.
std::string show_changes(const Lines& before, const Lines& after) {
  std::size_t first = 1;
  while (first <= std::min(before.count(), after.count()) && before[first] == after[first]) {
    ++first;
  }
  std::size_t same = 0;
  while (same + first <= std::min(before.count(), after.count()) &&
         before[before.count() - same] == after[after.count() - same]) {
    ++same;
  }
  std::string text;
  constexpr std::size_t around = 3;
  for (std::size_t line = first; line + same <= before.count(); ++line) {
    text += "  - " + before[line] + "\n";
  }
  const std::size_t begin = first > around ? first - around : 1;
  const std::size_t end = std::min(after.count(), after.count() - same + around);
  for (std::size_t line = begin; line <= end; ++line) {
    text += std::to_string(line) + (line >= first && line + same <= after.count() ? " + " : "   ") +
            after[line] + "\n";
  }
  return text;
}

/// Line breaks and a byte order mark as Windows writes them, which change nothing else.
std::string as_on_windows(const std::string& text) {
  std::string result = "\xEF\xBB\xBF";
  for (const char byte : text) result += byte == '\n' ? "\r\n" : std::string(1, byte);
  return result;
}

class MutationTest {
 public:
  MutationTest() : files_(file_bases()) {
    for (const auto& kinds : {syntax_mistakes(), key_mistakes(), value_mistakes(), name_mistakes(),
                              meaning_mistakes()}) {
      kinds_.insert(kinds_.end(), kinds.begin(), kinds.end());
    }
  }

  /// One mistake of the kind whose turn it is, in a catalog that has a place for it.
  void run(std::uint64_t seed) {
    constexpr int most_catalogs = 100;
    const MistakeKind& kind = kinds_[seed % kinds_.size()];
    Random random(seed);
    for (int i = 0; i < most_catalogs; ++i) {
      Base made;
      const Base* base = &made;
      if (random.percent(30)) {
        base = &random.pick(files_);
      } else {
        made = make_base("random", random_catalog_text(random));
        if (!made.errors.empty() || made.outline == nullptr) {
          ADD_FAILURE() << "seed " << seed << ": not good:\n" << made.errors;
          ++failures_;
          return;
        }
      }
      const auto mutation = kind.apply(*base->outline, random);
      if (!mutation) continue;
      ++applied_[kind.name];
      const bool on_windows = random.percent(20);
      const auto findings = lint(on_windows ? as_on_windows(mutation->text) : mutation->text);
      const std::string wrong = check(*base, *mutation, findings);
      if (!wrong.empty()) fail(seed, kind, *base, *mutation, findings, wrong);
      return;
    }
  }

  [[nodiscard]] std::size_t failures() const { return failures_; }
  [[nodiscard]] const std::vector<MistakeKind>& kinds() const { return kinds_; }
  [[nodiscard]] std::uint64_t applied(std::string_view kind) const {
    const auto found = applied_.find(kind);
    return found == applied_.end() ? 0 : found->second;
  }

 private:
  void fail(std::uint64_t seed, const MistakeKind& kind, const Base& base, const Mutation& mutation,
            const std::vector<Diagnostic>& findings, const std::string& wrong) {
    ++failures_;
    std::string shown;
    for (const Diagnostic& finding : findings) shown += show(finding);
    ADD_FAILURE() << "CBC_SEED=" << seed << ", " << kind.name << " in " << base.name << "\n"
                  << wrong << "--- changed lines\n"
                  << show_changes(base.outline->lines(), Lines(mutation.text)) << "--- findings\n"
                  << shown;
  }

  std::vector<Base> files_;
  std::vector<MistakeKind> kinds_;
  std::map<std::string_view, std::uint64_t> applied_;
  std::size_t failures_ = 0;
};

TEST(LintMutation, EachMistakeIsFoundWhereItWasMade) {
  const std::uint64_t seed = environment("CBC_SEED", default_seed);
  const std::uint64_t cases = environment("CBC_PROPERTY_CASES", default_mutations);
  std::cout << "CBC_SEED=" << seed << " CBC_PROPERTY_CASES=" << cases << std::endl;

  MutationTest test;
  for (std::uint64_t i = 0; i < cases && test.failures() < failures_shown; ++i) test.run(seed + i);
  if (test.failures() > 0 || cases < cases_for_statistics) return;
  for (const MistakeKind& kind : test.kinds()) {
    std::cout << "  " << test.applied(kind.name) << "  " << kind.name << "\n";
    EXPECT_GE(test.applied(kind.name), cases / test.kinds().size() / 2)
        << "too rare: " << kind.name;
  }
}

}  // namespace
}  // namespace cbc::mutation::lint_mutation_test
