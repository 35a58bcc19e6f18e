#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"

namespace cbc::test {

/// A coordinator on a catalog, spoken to by names. What it answers is kept as text until the next
/// call that can make something happen.
class Stage final : private EventListener {
 public:
  using Situation = std::vector<std::pair<std::string, bool>>;

  explicit Stage(std::string_view catalog, const CoordinatorOptions& options = {},
                 const Situation& situation = {});

  /// Each returns outcomes(). `parameters` are in canonical form.
  std::string start(std::string_view task, std::optional<std::int32_t> priority = {},
                    std::optional<std::string_view> parameters = {});
  std::string stop(std::string_view task, std::optional<std::int32_t> priority = {});
  std::string finish(std::string_view behavior, FinishCause cause = FinishCause::goal_achieved);
  /// Of whatever performs the task.
  std::string finish_task(std::string_view task, FinishCause cause = FinishCause::goal_achieved);
  std::string set(const Situation& situation);
  /// By the names of the variables and values, and availabilities of behaviors.
  std::string set_variables(
      const std::vector<std::pair<std::string_view, std::string_view>>& variables,
      const Situation& situation = {});
  std::string fault(std::string_view behavior);
  std::string repair(std::string_view behavior);
  std::string wait();
  /// Moves the clock, in seconds, through everything that is due before.
  std::string advance_to(double seconds);
  /// The same, and then through what is due at that instant.
  std::string settle_at(double seconds);

  /// What happened in the last call: "accepted" for each event, "; " between them.
  [[nodiscard]] const std::string& outcomes() const { return outcomes_; }
  /// "4.08 reactive start HOVER 0 accepted; …". The time is left out at 0, the origin if it is
  /// the script.
  [[nodiscard]] const std::string& events() const { return events_; }
  /// In order, "+a requested 2, -b released, +c required failed; …". The tasks are given, as in
  /// "+a(A,B)", if they are several, or not all that the behavior can perform.
  [[nodiscard]] const std::string& changes() const { return changes_; }
  /// "A goal_achieved, B interrupted; …".
  [[nodiscard]] const std::string& stopped() const { return stopped_; }
  /// "optimal protection 2 escalated sizes 1 2 1; …"; "none" without a search.
  [[nodiscard]] const std::string& searches() const { return searches_; }
  /// "1/2 idle 1/3 changes 2; …"; "none" without an objective.
  [[nodiscard]] const std::string& objectives() const { return objectives_; }
  [[nodiscard]] Coordinator::Status status() const { return status_; }

  // The state, in catalog order.

  /// "A=a B=b"
  [[nodiscard]] std::string running() const;
  /// "A:2 B:0"
  [[nodiscard]] std::string requests() const;
  /// "HOVER@4.08"
  [[nodiscard]] std::string queue() const;
  /// "HOVER LAND"
  [[nodiscard]] std::string waiting() const;
  /// "A@15"
  [[nodiscard]] std::string timeouts() const;
  /// "a b"
  [[nodiscard]] std::string active() const;

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }
  [[nodiscard]] const State& state() const { return coordinator_.state(); }

 private:
  void on_event(const EventRecord& record) override;
  void forget();
  std::string handle(Event event);
  std::string conclude(Coordinator::Status status);
  [[nodiscard]] std::uint32_t task_index(std::string_view name) const;
  [[nodiscard]] std::uint32_t behavior_index(std::string_view name) const;
  [[nodiscard]] std::vector<Availability> availabilities_of(const Situation& situation) const;
  [[nodiscard]] std::string show(const EventRecord& record, const Change& change) const;
  [[nodiscard]] std::string show(const Timers& timers) const;

  CompiledCatalog catalog_;
  Coordinator coordinator_;
  Coordinator::Status status_ = Coordinator::Status::ok;
  std::string outcomes_;
  std::string events_;
  std::string changes_;
  std::string stopped_;
  std::string searches_;
  std::string objectives_;
};

}  // namespace cbc::test
