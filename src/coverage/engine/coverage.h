#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/property/properties.h"
#include "coverage/engine/goals.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// How many goals there are, and how many of them are met. Those that are proven unreachable do not
/// count as goals.
struct GoalCount {
  std::uint64_t goals = 0;
  std::uint64_t met = 0;
  std::uint64_t unreachable = 0;

  void add(bool is_met, bool is_unreachable = false) {
    if (is_unreachable) {
      ++unreachable;
      return;
    }
    ++goals;
    if (is_met) ++met;
  }
  void add(const GoalCount& other) {
    goals += other.goals;
    met += other.met;
    unreachable += other.unreachable;
  }
  /// Tenths of a percent, rounded down, so that 1000 means all; of no goals 1000.
  [[nodiscard]] std::uint64_t tenths() const { return goals == 0 ? 1000 : met * 1000 / goals; }
};

/// "92.5 %"; of no goals a dash.
[[nodiscard]] std::string describe_percent(const GoalCount& count);

/// Which goals of a catalog some missions meet.
class CatalogCoverage {
 public:
  /// `text`: of the catalog. `goals` have their lines.
  CatalogCoverage(std::shared_ptr<const CompiledCatalog> catalog, std::string text,
                  std::vector<Goal> goals);

  /// Adds a mission, or what is new of one that was added before. `met`: by goal.
  void add(const std::string& mission, const std::vector<std::uint8_t>& met);

  /// Sets goals apart that are proven unreachable: by goal why, or nothing. Those that a mission
  /// meets all the same stay, as missions need not keep to the assumptions. `is_complete`: whether
  /// the others are proven to be reachable.
  void set_unreachable(std::vector<std::string> reasons, StatedAssumptions assumptions,
                       bool is_complete) {
    reasons_ = std::move(reasons);
    assumptions_ = std::move(assumptions);
    is_proved_ = is_complete;
  }
  /// Whether nothing ended a proof.
  [[nodiscard]] bool is_proved() const { return is_proved_; }
  [[nodiscard]] bool is_unreachable(std::size_t goal) const {
    return !reasons_.empty() && !reasons_[goal].empty() && !is_met(goal);
  }
  /// Why a goal is unreachable.
  [[nodiscard]] const std::string& reason_of(std::size_t goal) const { return reasons_[goal]; }
  /// The assumptions of the proof; empty if nothing was to be proven.
  [[nodiscard]] const std::optional<StatedAssumptions>& assumptions() const { return assumptions_; }
  [[nodiscard]] bool is_missed(std::size_t goal) const {
    return !is_met(goal) && !is_unreachable(goal);
  }

  [[nodiscard]] const CompiledCatalog& catalog() const { return *catalog_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  /// The digest of the text.
  [[nodiscard]] const std::string& digest() const { return digest_; }
  [[nodiscard]] const std::vector<Goal>& goals() const { return goals_; }
  /// In the order in which they came.
  [[nodiscard]] const std::vector<std::string>& missions() const { return missions_; }
  /// The missions that meet a goal, as places in missions(), ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& missions_of(std::size_t goal) const {
    return met_by_[goal];
  }
  [[nodiscard]] bool is_met(std::size_t goal) const { return !met_by_[goal].empty(); }

  [[nodiscard]] std::array<GoalCount, goal_sections> by_section() const;
  [[nodiscard]] GoalCount total() const;
  /// By line of the text, counted from 1: its goals, as places in goals().
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> goals_of_lines() const;

 private:
  std::shared_ptr<const CompiledCatalog> catalog_;
  std::string text_;
  std::string digest_;
  std::vector<Goal> goals_;
  std::vector<std::string> missions_;
  std::vector<std::vector<std::uint32_t>> met_by_;  ///< by goal
  std::vector<std::string> reasons_;                ///< by goal; empty: nothing is proven
  std::optional<StatedAssumptions> assumptions_;
  bool is_proved_ = true;
};

/// The coverage of several catalogs, each by the missions that run on it.
struct Coverage {
  std::vector<CatalogCoverage> catalogs;

  [[nodiscard]] GoalCount total() const;
};

}  // namespace cbc
