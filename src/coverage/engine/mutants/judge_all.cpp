// Comparisons take milliseconds or for ever, and nobody knows which before. So under a time limit
// each gets an equal share of the time that is left when it begins, and what it does not use is
// shared by the others. In the end those that were cut short begin again, as many as can have at
// least twice the time that they had (restarts with growing limits: M. Luby, A. Sinclair and
// D. Zuckerman, "Optimal speedup of Las Vegas algorithms", Information Processing Letters 47
// (1993)). To go on where they were would save half of that time, but the memory of all of them
// would have to be kept.
//
// Memory is shared, too, by those that run at the same time. What takes more than its share runs
// once more, alone, so that verdicts do not depend on the number of threads.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

#include "core/support/system.h"
#include "coverage/engine/mutants/mutants.h"

namespace cbc {
namespace {

/// A mutant that no mission notices, and of which nothing is known yet.
struct OpenMutant {
  std::size_t number = 0;
  double had = 0;  ///< the longest time that it was given
  bool is_alone = false;
};

class Judging {
 public:
  Judging(const MutantJudge& judge, std::span<const Mutant> mutants, const JudgingOptions& options)
      : judge_(judge), mutants_(mutants), options_(options), verdicts_(mutants.size()) {}

  std::vector<MutantVerdict> judge() {
    run_missions();
    std::vector<OpenMutant> open;
    for (std::size_t number = 0; number < mutants_.size(); ++number) {
      if (verdicts_[number].result == MutantVerdict::Result::undecided) open.push_back({number});
    }
    open_count_ = open.size();
    for (bool goes_on = true; goes_on;) {
      const bool were_any = compare_some(open, false);
      goes_on = compare_some(open, true) || were_any;
    }
    return std::move(verdicts_);
  }

 private:
  void run_missions() {
    for_each(mutants_.size(), options_.jobs, [&](std::size_t number, const auto& show) {
      show(false, number, mutants_.size());
      verdicts_[number] = judge_.run_missions(mutants_[number], options_.is_stopped);
    });
  }

  /// Calls work(number, show) for all numbers below `count`, on several threads. `show` passes on
  /// the progress, if the thread is this one.
  template <typename Work>
  void for_each(std::size_t count, std::size_t jobs, const Work& work) {
    for_each_in_threads(count, jobs, [&](std::size_t job, std::size_t place) {
      work(place, [&](bool is_compared, std::size_t done, std::size_t of) {
        if (job == 0 && options_.on_progress) options_.on_progress(is_compared, done, of);
      });
    });
  }

  /// Compares those that are to run alone, or the others: all, or those that get enough time.
  /// Removes from `open` what is known then. False if there was nothing to do.
  bool compare_some(std::vector<OpenMutant>& open, bool is_alone) {
    const std::size_t jobs = is_alone ? 1 : options_.jobs;
    // Those with the least time first, then in the order of mutants.
    std::stable_sort(open.begin(), open.end(), [&](const OpenMutant& a, const OpenMutant& b) {
      if (a.is_alone != b.is_alone) return a.is_alone == is_alone;
      return a.had < b.had;
    });
    std::size_t count = 0;
    while (count < open.size() && open[count].is_alone == is_alone) ++count;
    while (count > 0 && !is_worth_it(open[count - 1], share_of(count, jobs))) --count;
    if (count == 0) return false;
    std::atomic<std::size_t> left{count};
    for_each(count, jobs, [&](std::size_t place, const auto& show) {
      compare_one(open[place], left, jobs, show);
      --left;
    });
    std::erase_if(open, [](const OpenMutant& one) { return one.number == known; });
    return true;
  }

  template <typename Show>
  void compare_one(OpenMutant& one, const std::atomic<std::size_t>& left, std::size_t jobs,
                   const Show& show) {
    MutantJudge::Limits limits;
    limits.max_states = options_.max_states;
    limits.max_memory = options_.max_memory / jobs;
    const double begin = seconds_left();
    const double share = share_of(left, jobs);
    bool is_over = false;
    limits.is_stopped = [&] {
      show(true, known_count_, open_count_);
      is_over = is_over || is_stopped() || (has_limit() && begin - seconds_left() >= share);
      return is_over;
    };
    MutantVerdict& verdict = verdicts_[one.number];
    verdict = judge_.compare(mutants_[one.number], limits);
    const bool may_be_known = verdict.result == MutantVerdict::Result::undecided &&
                              verdict.doubt == MutantVerdict::Doubt::limit;
    const bool is_short_of_memory = verdict.lacks_memory && jobs > 1;
    if (may_be_known && is_short_of_memory) {
      one.is_alone = true;
      one.had = 0;
    } else if (may_be_known && is_over) {
      one.had = share;
    } else {
      one.number = known;
      ++known_count_;
    }
  }

  [[nodiscard]] bool is_stopped() const { return options_.is_stopped && options_.is_stopped(); }
  [[nodiscard]] bool has_limit() const { return options_.seconds_left != nullptr; }
  [[nodiscard]] double seconds_left() const { return has_limit() ? options_.seconds_left() : 0; }

  /// Of the time, if so many are left.
  [[nodiscard]] double share_of(std::size_t count, std::size_t jobs) const {
    const std::size_t turns = (count + jobs - 1) / jobs;
    return seconds_left() / static_cast<double>(turns);
  }
  /// With less time than twice as much it would hardly come further.
  [[nodiscard]] bool is_worth_it(const OpenMutant& one, double share) const {
    return !is_stopped() && (!has_limit() || (share > 0 && share >= 2 * one.had));
  }

  static constexpr std::size_t known = SIZE_MAX;

  const MutantJudge& judge_;
  const std::span<const Mutant> mutants_;
  const JudgingOptions& options_;
  std::vector<MutantVerdict> verdicts_;  ///< by mutant
  std::size_t open_count_ = 0;           ///< after the missions
  std::atomic<std::size_t> known_count_{0};
};

}  // namespace

std::vector<MutantVerdict> judge_all(const MutantJudge& judge, std::span<const Mutant> mutants,
                                     const JudgingOptions& options) {
  return Judging(judge, mutants, options).judge();
}

}  // namespace cbc
