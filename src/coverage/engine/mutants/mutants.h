#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "core/catalog/catalog.h"
#include "core/property/properties.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// A catalog with one thing changed (docs/coverage.md, "Mutants"). What was changed depends on the
/// kind; everything else is `none`. Numbers are places in the Catalog.
struct Mutant {
  enum class Kind : std::uint8_t {
    behavior_removed,           ///< behavior, which can never be active
    suitability_lowered,        ///< behavior and its task, to `suitability`, below that of `other`
    requirement_removed,        ///< behavior and the task that it requires
    minimum_removed,            ///< task; of a requirement, also the behavior
    condition_removed,          ///< behavior and variable
    exclusion_removed,          ///< task and other, of which it is the first in the catalog
    exclusion_narrowed,         ///< task, in `list`
    timeout_removed,            ///< task, or behavior with a timeout of its own
    start_on_request_turned,    ///< task
    reactive_start_turned,      ///< task
    execution_goal_turned,      ///< task, to achieve_goal, so that it may time out
    improve_removed,            ///< task
    resume_removed,             ///< task
    reactive_priority_removed,  ///< task
    retry_removed,              ///< behavior
    limit_raised                ///< one more task of `list` may run; task is one of them
  };
  static constexpr std::size_t kinds = 16;
  static constexpr std::uint32_t none = UINT32_MAX;

  Kind kind = Kind::behavior_removed;
  std::uint32_t task = none;
  std::uint32_t other = none;  ///< a task; of suitability_lowered the behavior that comes next
  std::uint32_t behavior = none;
  std::uint32_t variable = none;
  std::uint32_t list = none;  ///< place in Catalog::exclusivity
  Millionths suitability = 0;
  std::vector<std::uint32_t> lines;  ///< of the catalog, ascending, at least one
};

/// The word of a kind in JSON.
[[nodiscard]] std::string_view name_of(Mutant::Kind kind);

/// All mutants of a catalog, by their first line.
[[nodiscard]] std::vector<Mutant> find_mutants(const Catalog& catalog);

/// The catalog with the change: a valid one with the same tasks, behaviors and variables in the
/// same places, so that a script for the one is a script for the other. A behavior that is removed
/// stays in it, but fits in no situation; a variable is added for this.
[[nodiscard]] Catalog mutate(const Catalog& catalog, const Mutant& mutant);

/// What was changed, in words: "HOVER_STILL no longer requires LOCALIZE".
[[nodiscard]] std::string describe(const Catalog& catalog, const Mutant& mutant);

// Which of them the missions notice.

/// How a mission tells that a catalog is not the one that it was written for.
struct Notice {
  enum class How : std::uint8_t {
    failed,  ///< an expectation does not hold
    ended    ///< the run ended early
  };
  How how = How::failed;
  std::size_t mission = 0;  ///< its place among the missions
  std::uint32_t line = 0;   ///< of the expectation; 0: none
  std::string message;
};

/// The word of a way in JSON.
[[nodiscard]] std::string_view name_of(Notice::How how);

/// Runs a mission, which is for this catalog or for one that it is a mutant of, up to the first
/// expectation that fails. Empty if all hold. `is_stopped`: asked now and then; true ends the run
/// as if all held. May be empty.
[[nodiscard]] std::optional<Notice> find_notice(const CompiledCatalog& catalog,
                                                const Script& mission,
                                                const std::function<bool()>& is_stopped = {});

/// What is known of a mutant.
struct MutantVerdict {
  enum class Result : std::uint8_t {
    noticed,
    survived,    ///< no mission notices it, although the script would
    equivalent,  ///< no mission can notice it, as far as the assumptions allow its events
    undecided,   ///< no mission notices it, and it is not known whether one can; see Doubt
    unjudged     ///< the end came before all missions had run
  };
  /// Why it is not known whether a mission can notice a mutant.
  enum class Doubt : std::uint8_t {
    limit,     ///< a limit came first
    no_script  ///< it differs between states, which have no times, but no script that was tried
               ///< shows it
  };
  Result result = Result::unjudged;
  Doubt doubt = Doubt::limit;         ///< if it is undecided
  bool lacks_memory = false;          ///< undecided as the memory was too small
  std::optional<Notice> notice;       ///< the first one, if it is noticed
  std::optional<std::string> script;  ///< of a survivor: a mission that would notice it
};

/// The word of a result in JSON.
[[nodiscard]] std::string_view name_of(MutantVerdict::Result result);
[[nodiscard]] std::string_view name_of(MutantVerdict::Doubt doubt);

/// Judges one mutant, also on several threads at once.
class MutantJudge {
 public:
  /// What the comparison of one mutant with the catalog may take.
  struct Limits {
    std::uint64_t max_states = 0;  ///< 0: no limit
    std::uint64_t max_memory = 0;  ///< bytes; 0: no limit
    /// Asked now and then; true ends the comparison. May be empty.
    std::function<bool()> is_stopped;
  };

  /// `source` is what the catalog was compiled from; both, and the missions, must outlive the
  /// judge. All missions pass on the catalog. `assumptions`: which events a mission may have; the
  /// first state does not contradict them.
  MutantJudge(const Catalog& source, const CompiledCatalog& catalog,
              const std::vector<Script>& missions, Assumptions assumptions);

  /// Runs the missions: the mutant is noticed, or undecided for now. Unjudged if it was stopped.
  [[nodiscard]] MutantVerdict run_missions(const Mutant& mutant,
                                           const std::function<bool()>& is_stopped) const;
  /// Compares a mutant that no mission notices with the catalog.
  [[nodiscard]] MutantVerdict compare(const Mutant& mutant, const Limits& limits) const;

 private:
  [[nodiscard]] GroupId group_of(const Mutant& mutant) const;
  void compare_states(const Mutant& mutant, const CompiledCatalog& changed, const Limits& limits,
                      MutantVerdict& verdict) const;
  void compare_times(const Mutant& mutant, const Catalog& changed_source,
                     const CompiledCatalog& changed, const Limits& limits,
                     MutantVerdict& verdict) const;

  const Catalog& source_;
  const CompiledCatalog& catalog_;
  const std::vector<Script>& missions_;
  const Assumptions assumptions_;
};

struct JudgingOptions {
  std::uint64_t max_states = 0;  ///< of each comparison; 0: no limit
  std::uint64_t max_memory = 0;  ///< bytes, of all comparisons at a time; 0: no limit
  unsigned jobs = 1;             ///< mutants at a time
  /// Asked now and then, perhaps by several threads at once; true ends the work. May be empty.
  std::function<bool()> is_stopped;
  /// How much time is left, of which each comparison gets its share. Empty: there is no limit.
  std::function<double()> seconds_left;
  /// Called now and then in this thread: `done` of `count` mutants have seen the missions, or have
  /// been compared. May be empty.
  std::function<void(bool is_compared, std::size_t done, std::size_t count)> on_progress;
};

/// Judges mutants: first all by the missions, which is quick, and then those that no mission
/// notices by comparison. Without `seconds_left` the verdicts are the same for any number of jobs.
[[nodiscard]] std::vector<MutantVerdict> judge_all(const MutantJudge& judge,
                                                   std::span<const Mutant> mutants,
                                                   const JudgingOptions& options);

}  // namespace cbc
