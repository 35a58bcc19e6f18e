// Random catalogs and questions: the tolerance of a number over all states must be what a plain
// comparison of both catalogs says, at the bounds, one step beyond them, and inside; with the
// shortest way to a difference, and the promises that break. CBC_SEED and CBC_PROPERTY_CASES are as
// in property_test.cpp.
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "catalog_changes.h"
#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/words/move_words.h"
#include "demand.h"
#include "explore/properties/verification.h"
#include "model.h"
#include "plain_comparison.h"
#include "plain_exploration.h"
#include "random.h"
#include "random_cases.h"
#include "read_yaml.h"
#include "tune/engine/numbers.h"
#include "tune/engine/state_tuner.h"
#include "verify_case.h"
#include "yaml_text.h"

namespace cbc::plain::tune_states_property_test {
namespace {

using oracle::demand;
using oracle::Random;

constexpr std::uint64_t default_cases = 60;
constexpr std::size_t numbers_per_case = 2;
constexpr std::size_t values_inside = 2;
constexpr std::uint64_t most_states = 500;

class CaseCheck {
 public:
  CaseCheck(const CatalogReading& reading, const PropertyFile& file, Random& random,
            oracle::Statistics& statistics)
      : catalog_(reading.catalog),
        numbers_(find_numbers(reading)),
        file_(file),
        random_(random),
        statistics_(statistics),
        present_(compile(catalog_)) {}

  void check() {
    if (numbers_.empty()) return;
    ExplorationOptions options;
    options.jobs = random_.percent(50) ? 2 : 1;
    options.budget.max_states = most_states;
    const StateTuner tuner(catalog_, numbers_, file_, options);
    if (tuner.present().end || tuner.present().error) return;
    for (std::size_t count = 0; count < numbers_per_case; ++count) {
      const std::size_t number = random_.below(numbers_.size());
      const auto found = tuner.tolerance(number);
      if (found.end) continue;
      check_number(numbers_[number], found.tolerance, tuner.is_used(number));
    }
  }

 private:
  [[nodiscard]] CompiledCatalog with(const TunableNumber& number, std::int64_t value) const {
    Catalog changed = catalog_;
    set_number(changed, number, static_cast<Millionths>(value));
    return compile(changed);
  }
  [[nodiscard]] PlainComparison compare(const TunableNumber& number, std::int64_t value) const {
    return compare_plainly(with(number, value), present_, file_.assumptions, most_states);
  }
  void check_same(const TunableNumber& number, std::int64_t value) {
    const PlainComparison plain = compare(number, value);
    demand(!plain.differs, "a difference at " + std::to_string(value));
    if (plain.is_complete) statistics_.count("value inside");
  }

  void check_number(const TunableNumber& number, const Tolerance& tolerance, bool is_used) {
    const Interval& values = tolerance.values;
    demand(values.low <= number.value && number.value <= values.high, "the value is outside");
    demand(tolerance.below.has_value() == (values.low > 0), "below");
    demand(tolerance.above.has_value() == (values.high < one_million), "above");
    check_same(number, values.low);
    check_same(number, values.high);
    for (std::size_t count = 0; count < values_inside; ++count) {
      check_same(number, random_.between(values.low, values.high));
    }
    if (tolerance.below) check_beyond(number, std::int64_t{values.low} - 1, *tolerance.below);
    if (tolerance.above) check_beyond(number, std::int64_t{values.high} + 1, *tolerance.above);
    if (!is_used) {
      demand(!tolerance.below && !tolerance.above, "a number that nothing uses has a bound");
      statistics_.count("unused");
    }
    if (!tolerance.below && !tolerance.above) statistics_.count("no bound");
  }

  void check_beyond(const TunableNumber& number, std::int64_t value,
                    const RunDifference& difference) {
    const PlainComparison plain = compare(number, value);
    if (!plain.is_complete && !plain.differs) return;
    demand(plain.differs, "no difference at " + std::to_string(value));
    demand(difference.in_state.has_value(), "no path");
    std::vector<std::string> moves;
    const Witness& path = difference.in_state->path;
    describe_moves(present_, path.script, path.due, moves);
    demand(
        moves.size() == plain.moves.size(),
        std::to_string(moves.size()) + " moves in place of " + std::to_string(plain.moves.size()));
    statistics_.count("bound");
    if (number.uses.size() > 1) statistics_.count("bound of several pairs");
    if (number.kind == TunableNumber::Kind::minimum_performance) {
      statistics_.count("bound of a minimum");
    }
    check_broken(with(number, value), difference.in_state->broken_property);
  }

  void check_broken(const CompiledCatalog& changed, std::optional<std::size_t> broken) {
    for (std::size_t place = 0; place < file_.properties.size(); ++place) {
      const auto before = find_result(present_, file_.properties[place]);
      const auto now = find_result(changed, file_.properties[place]);
      if (!before || !now) return;
      const bool breaks = *before == Verdict::Result::proved && *now == Verdict::Result::violated;
      demand(breaks == (broken == place), "which property breaks");
      if (!breaks) continue;
      statistics_.count("broken property");
      return;
    }
    demand(!broken, "no property breaks");
  }
  [[nodiscard]] std::optional<Verdict::Result> find_result(const CompiledCatalog& catalog,
                                                           const Property& property) const {
    const Exploration explored = explore_plainly(catalog, scope_of(catalog, property).groups,
                                                 file_.assumptions, {&property}, most_states);
    if (explored.error || (!explored.complete && !explored.decided)) return std::nullopt;
    return explored.verdicts.front().result;
  }

  const Catalog& catalog_;
  const std::vector<TunableNumber> numbers_;
  const PropertyFile& file_;
  Random& random_;
  oracle::Statistics& statistics_;
  const CompiledCatalog present_;
};

void run_case(std::uint64_t seed, oracle::Results& results) {
  VerifyCase sample = generate_verify_case(seed);
  Random random(~seed);
  share_a_suitability(sample.source, random);
  const std::string text = oracle::catalog_yaml(sample.source, random);
  try {
    const CatalogReading reading =
        oracle::read_yaml(text, [](const auto& document, auto& diagnostics) {
          return understand_catalog(document, diagnostics);
        });
    PropertyFile file;
    file.assumptions = sample.question.assumptions;
    file.properties = sample.question.properties;
    CaseCheck(reading, file, random, results.statistics).check();
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" + text +
                                        text_of(sample) + "--- " + error.what() + "\n"});
  }
}

const oracle::LowerBound lower_bounds[] = {
    {"value inside", 4000},     {"bound", 500},    {"bound of several pairs", 50},
    {"bound of a minimum", 40}, {"no bound", 400}, {"unused", 100},
    {"broken property", 10},
};

TEST(TuneStates, TolerancesAreThoseOfThePlainComparison) {
  oracle::run_random_cases(default_cases, run_case, lower_bounds);
}

}  // namespace
}  // namespace cbc::plain::tune_states_property_test
