#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/property/properties.h"
#include "core/script/script.h"
#include "coverage/engine/mutants/mutants.h"
#include "runtime/compiled/compiled_catalog.h"
#include "verify/engine/explore.h"

namespace cbc {

// Which mutants of a catalog its missions notice (docs/coverage.md, "Mutants").

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
  std::optional<Notice> notice;       ///< the first one, if it is noticed
  std::optional<std::string> script;  ///< of a survivor: a mission that would notice it
};

/// The word of a result in JSON.
[[nodiscard]] std::string_view name_of(MutantVerdict::Result result);
[[nodiscard]] std::string_view name_of(MutantVerdict::Doubt doubt);

struct JudgeOptions {
  ExplorationLimits limits;  ///< of the exploration for one mutant; the time does not count
  /// Asked now and then, perhaps by several threads at once; true ends the work. May be empty.
  std::function<bool()> is_stopped;
};

/// Judges mutants, one after the other or several at once.
class MutantJudge {
 public:
  /// `source` is what the catalog was compiled from; both, and the missions, must outlive the
  /// judge. All missions pass on the catalog. `assumptions`: which events a mission may have; the
  /// first state does not contradict them.
  MutantJudge(const Catalog& source, const CompiledCatalog& catalog,
              const std::vector<Script>& missions, Assumptions assumptions, JudgeOptions options);

  [[nodiscard]] MutantVerdict judge(const Mutant& mutant) const;

  /// A behavior that times out with one of its tasks in only one of two catalogs, or earlier.
  struct TimeDifference {
    TaskIndex task = 0;
    BehaviorIndex behavior = 0;
    Microseconds first = 0;  ///< the shorter timeout
  };

 private:
  [[nodiscard]] bool is_stopped() const { return options_.is_stopped && options_.is_stopped(); }
  [[nodiscard]] GroupId group_of(const Mutant& mutant) const;
  void compare(const Mutant& mutant, const CompiledCatalog& changed, MutantVerdict& verdict) const;
  void compare_times(const Mutant& mutant, const Catalog& changed_source,
                     const CompiledCatalog& changed, MutantVerdict& verdict) const;
  [[nodiscard]] bool never_time_out(const CompiledCatalog& catalog,
                                    const std::vector<TimeDifference>& differences) const;

  const Catalog& source_;
  const CompiledCatalog& catalog_;
  const std::vector<Script>& missions_;
  const Assumptions assumptions_;
  const JudgeOptions options_;
};

}  // namespace cbc
