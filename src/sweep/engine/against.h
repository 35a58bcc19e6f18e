#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "sweep/engine/draw.h"
#include "versions/names/translation.h"

namespace cbc {

// What two versions of a catalog decide differently about the same random events. Unlike `cbc
// verify --same-as`, which visits all states, this finds what is frequent, in catalogs of any size.

/// One thing that is decided differently.
struct SweptDifference {
  std::string line;             ///< "LOCALIZE: FLOAT_GNSS in place of LIDAR_SLAM"
  std::uint64_t sequences = 0;  ///< how many show it
  // Of those that show it after the fewest events, the first one:
  std::uint64_t sequence = 0;  ///< counts from 1
  std::uint64_t events = 0;    ///< of its script
  std::string script;          ///< for the new catalog, expecting what that decides
};

struct SweptComparison {
  std::string old_catalog;  ///< path of the source, as the user gave it
  std::string old_digest;   ///< see SweepResult
  CatalogNames names;
  std::uint64_t events = 0;                  ///< scripted ones whose answers were compared
  std::uint64_t sequences = 0;               ///< that show a difference
  std::vector<SweptDifference> differences;  ///< the most frequent first
};

/// Two catalogs, and what is the same in them. The catalogs must outlive it.
struct ComparedVersions {
  ComparedVersions(const CompiledCatalog& old_version, const CompiledCatalog& new_version,
                   const Renames& renames);

  /// A task of both.
  struct Task {
    TaskId of_new;
    TaskId of_old;
  };

  // Without reactive starts of tasks that the other one does not have.
  CompiledCatalog old_catalog;
  CompiledCatalog new_catalog;
  TranslationPair translations;
  CatalogNames names;
  DrawnNames drawn;                        ///< places in the new catalog
  std::vector<std::vector<Task>> tasks;    ///< by number of groups that belong together
  std::vector<std::uint32_t> part_of_new;  ///< by group: the place of its tasks in `tasks`
  std::vector<std::uint32_t> part_of_old;  ///< the same
};

/// Runs the events of sequences on the old catalog as well, and compares: after each one the
/// outcome, and the running tasks with their behaviors. After a difference the groups that it is
/// about are not compared any more in its sequence, as all that follows would differ, too.
class SequenceComparison final : public EventListener {
 public:
  SequenceComparison(const ComparedVersions& catalogs, CoordinatorOptions options);

  struct Found {
    std::uint64_t sequences = 0;
    std::uint64_t sequence = 0;  ///< from 0
    std::uint64_t steps = 0;     ///< of the sequence
    bool is_by_clock = false;    ///< between the last two of them
    Expectation expectation;     ///< of what the new catalog does

    void add(const Found& other);
  };
  struct Totals {
    std::uint64_t events = 0;
    std::uint64_t sequences = 0;
    std::map<std::string, Found> found;  ///< by line

    void add(const Totals& other);
  };

  void begin(std::uint64_t sequence);
  /// An event of the old catalog.
  void on_event(const EventRecord& record) override { note(record, false); }
  /// An event of the new catalog.
  void on_new_event(const EventRecord& record) { note(record, true); }
  /// The new catalog has done all that is due before this time.
  void on_time(Microseconds time, const State& new_state);
  /// The new catalog has handled the step.
  void on_step(const Step& step, const State& new_state);
  /// How the run of the old catalog goes.
  [[nodiscard]] Coordinator::Status status() const { return status_; }
  [[nodiscard]] const std::string& internal_error() const { return run_->internal_error(); }

  [[nodiscard]] const Totals& totals() const { return totals_; }

 private:
  void note(const EventRecord& record, bool is_new);
  void compare_answers(const Step& step, const State& new_state);
  void compare_running(const State& new_state);
  void compare_part(std::uint32_t part, const State& new_state);
  void add(std::uint32_t part, const std::string& line, const State& new_state);
  [[nodiscard]] Expectation expectation_of(std::uint32_t part, const State& new_state) const;

  const ComparedVersions& catalogs_;
  const CoordinatorOptions options_;
  std::optional<Coordinator> run_;  ///< of the old catalog
  Coordinator::Status status_ = Coordinator::Status::ok;
  std::uint64_t sequence_ = 0;
  std::uint64_t steps_ = 0;
  bool is_by_clock_ = false;
  bool differs_ = false;                ///< the sequence
  std::vector<bool> is_over_;           ///< by part: it differs
  std::vector<std::uint32_t> touched_;  ///< parts that something was decided about
  // Of the last scripted event.
  std::optional<Outcome> new_outcome_;
  std::optional<Outcome> old_outcome_;
  Totals totals_;
};

}  // namespace cbc
