// How mutants share time and memory. Time is counted in looks at the clock, so that nothing depends
// on the machine.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "coverage/engine/goal_proof.h"
#include "coverage/engine/mutants/mutants.h"

namespace cbc::judge_mutants_test {
namespace {

using Result = MutantVerdict::Result;

/// A group of thousands of states, whose first mutants can only be told from the catalog, if at
/// all, once all of them are visited; after it a group of a few.
constexpr std::string_view robot = R"(
behaviors:
- {behavior: A1, task: A1, requires: [{task: MIDDLE}, {task: BASE}]}
- {behavior: MIDDLE, task: MIDDLE, requires: [{task: BASE}]}
- {behavior: BASE, task: BASE}
- {behavior: A2, task: A2, requires: [{task: BASE}]}
- {behavior: A3, task: A3, requires: [{task: BASE}]}
- {behavior: A4, task: A4, requires: [{task: BASE}]}
- {behavior: A5, task: A5, requires: [{task: BASE}]}
- {behavior: P, task: P}
- {behavior: Q, task: Q}
tasks:
- {task: A1}
- {task: MIDDLE, start_on_request: false}
- {task: BASE, start_on_request: false}
- {task: A2}
- {task: A3}
- {task: A4}
- {task: A5}
- {task: P}
- {task: Q}
exclusivity_constraints:
- mutually_exclusive: [P, Q]
)";

/// A mission that notices some of the last ones.
constexpr std::string_view mission = R"(
- start: P
- expect: {running: {P: P}}
- start: Q
- expect: {running: {Q: Q}, stopped: [P]}
)";

Catalog read(std::string_view text) {
  Diagnostics diagnostics;
  return read_catalog(text, "robot.yaml", diagnostics).value();
}

using Essence = std::vector<std::tuple<Result, MutantVerdict::Doubt, std::string>>;

Essence essence_of(const std::vector<MutantVerdict>& verdicts) {
  Essence all;
  for (const MutantVerdict& verdict : verdicts) {
    all.emplace_back(verdict.result, verdict.doubt, verdict.script.value_or(""));
  }
  return all;
}

std::size_t count(const std::vector<MutantVerdict>& verdicts, Result result) {
  return static_cast<std::size_t>(
      std::count_if(verdicts.begin(), verdicts.end(),
                    [&](const MutantVerdict& verdict) { return verdict.result == result; }));
}

class JudgeAll : public testing::Test {
 protected:
  [[nodiscard]] std::vector<MutantVerdict> judge(const JudgingOptions& options) const {
    return judge_all(judge_, mutants_, options);
  }
  /// With so much time; a look at the clock takes 1.
  [[nodiscard]] std::vector<MutantVerdict> judge_within(int looks) const {
    double left = looks;
    JudgingOptions options;
    options.seconds_left = [&left] { return left--; };
    return judge(options);
  }
  /// How often the comparison of a mutant looks whether it is stopped.
  [[nodiscard]] int looks_of(std::string_view change) const {
    int looks = 0;
    MutantJudge::Limits limits;
    limits.is_stopped = [&looks] { return ++looks, false; };
    static_cast<void>(judge_.compare(mutants_[place_of(change)], limits));
    return looks;
  }
  [[nodiscard]] std::size_t place_of(std::string_view change) const {
    const auto found = std::find_if(mutants_.begin(), mutants_.end(), [&](const Mutant& mutant) {
      return describe(source_, mutant) == change;
    });
    return static_cast<std::size_t>(found - mutants_.begin());
  }

  const Catalog source_ = read(robot);
  const CompiledCatalog catalog_ = compile(source_);
  const std::vector<Script> missions_ = [&] {
    Diagnostics diagnostics;
    const auto document = yaml::parse(mission, "mission.yaml", diagnostics);
    return std::vector<Script>{
        read_script(*document, catalog_, Severity::note, diagnostics).value()};
  }();
  const MutantJudge judge_{source_, catalog_, missions_, assumptions_of_goals(catalog_)};
  const std::vector<Mutant> mutants_ = find_mutants(source_);
};

constexpr std::string_view long_one = "A1 no longer requires BASE";
constexpr std::string_view last_one = "start_on_request of Q: false instead of true";

TEST_F(JudgeAll, LetsTheMissionsLookAtAllFirst) {
  const std::vector<MutantVerdict> verdicts = judge_within(0);
  EXPECT_EQ(count(verdicts, Result::noticed), 3U);
  EXPECT_EQ(count(verdicts, Result::undecided), verdicts.size() - 3);
  EXPECT_EQ(verdicts[place_of("P no longer excludes Q")].result, Result::noticed);
}

TEST_F(JudgeAll, GivesEachAShareOfTheTime) {
  constexpr int looks = 500;
  ASSERT_GT(looks_of(long_one) * 6, looks) << "the long ones alone take longer";
  const std::vector<MutantVerdict> whole = judge({});
  const std::vector<MutantVerdict> verdicts = judge_within(looks);
  EXPECT_EQ(verdicts[place_of(long_one)].result, Result::undecided);
  EXPECT_EQ(verdicts[place_of(long_one)].doubt, MutantVerdict::Doubt::limit);
  EXPECT_EQ(verdicts[place_of(last_one)].result, Result::equivalent);
  EXPECT_EQ(count(verdicts, Result::survived), count(whole, Result::survived));
}

TEST_F(JudgeAll, GivesWhatIsLeftToTheOthers) {
  const std::vector<MutantVerdict> whole = judge({});
  const std::size_t open = mutants_.size() - count(whole, Result::noticed);
  const int looks = looks_of(long_one) * static_cast<int>(open) * 4 / 5;
  EXPECT_EQ(essence_of(judge_within(looks)), essence_of(whole));
}

TEST_F(JudgeAll, DoesNotDependOnThreads) {
  const Essence whole = essence_of(judge({}));
  std::set<std::size_t> numbers;
  for (std::uint64_t memory = 1U << 16U; memory < (1U << 23U); memory += memory / 4) {
    JudgingOptions options;
    options.max_memory = memory;
    const std::vector<MutantVerdict> alone = judge(options);
    numbers.insert(count(alone, Result::undecided));
    for (const unsigned jobs : {2U, 7U}) {
      options.jobs = jobs;
      EXPECT_EQ(essence_of(judge(options)), essence_of(alone)) << jobs << " threads, " << memory;
    }
  }
  EXPECT_GT(numbers.size(), 2U) << "the memory makes no difference";
  JudgingOptions options;
  options.jobs = 5;
  EXPECT_EQ(essence_of(judge(options)), whole);
}

TEST_F(JudgeAll, LeavesWhatNoMissionHasSeenUnjudged) {
  JudgingOptions options;
  int looks = 0;
  options.is_stopped = [&looks] { return ++looks > 20; };
  const std::vector<MutantVerdict> verdicts = judge(options);
  EXPECT_GT(count(verdicts, Result::undecided), 0U);
  EXPECT_EQ(verdicts.back().result, Result::unjudged);
}

}  // namespace
}  // namespace cbc::judge_mutants_test
