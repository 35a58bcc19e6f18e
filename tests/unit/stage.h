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

  /// Each returns outcomes().
  std::string start(std::string_view task, std::optional<std::int32_t> priority = {});
  std::string stop(std::string_view task);
  std::string finish(std::string_view behavior, FinishCause cause = FinishCause::goal_achieved);
  std::string set(const Situation& situation);
  std::string fault(std::string_view behavior);
  /// Moves the clock, in seconds, through everything that is due before.
  std::string advance_to(double seconds);
  /// The same, and then through what is due at that instant.
  std::string settle_at(double seconds);

  /// What happened in the last call: "accepted" for each event, "; " between them.
  [[nodiscard]] const std::string& outcomes() const { return outcomes_; }
  /// In order, "+a requested 2, -b released, +c required failed; …".
  [[nodiscard]] const std::string& changes() const { return changes_; }
  /// "A goal_achieved, B interrupted; …".
  [[nodiscard]] const std::string& stopped() const { return stopped_; }
  /// "optimal protection 2 escalated sizes 1 2 1; …"; "none" without a search.
  [[nodiscard]] const std::string& searches() const { return searches_; }
  [[nodiscard]] Coordinator::Status status() const { return status_; }

  /// In catalog order, "A=a B=b"
  [[nodiscard]] std::string running() const;

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
  [[nodiscard]] std::string show(const Change& change) const;

  CompiledCatalog catalog_;
  Coordinator coordinator_;
  Coordinator::Status status_ = Coordinator::Status::ok;
  std::string outcomes_;
  std::string changes_;
  std::string stopped_;
  std::string searches_;
};

}  // namespace cbc::test
