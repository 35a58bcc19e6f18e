#include "coverage/engine/coverage.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "runtime/compiled/compiled_file.h"

namespace cbc {

std::string describe_percent(const GoalCount& count) {
  if (count.goals == 0) return "\u2013";
  return fmt::format("{}.{} %", count.tenths() / 10, count.tenths() % 10);
}

CatalogCoverage::CatalogCoverage(std::shared_ptr<const CompiledCatalog> catalog, std::string text,
                                 std::vector<Goal> goals)
    : catalog_(std::move(catalog)),
      text_(std::move(text)),
      digest_(to_hex(digest_of(text_))),
      goals_(std::move(goals)),
      met_by_(goals_.size()) {}

void CatalogCoverage::add(const std::string& mission, const std::vector<std::uint8_t>& met) {
  const auto found = std::find(missions_.begin(), missions_.end(), mission);
  const auto place = static_cast<std::uint32_t>(found - missions_.begin());
  if (found == missions_.end()) missions_.push_back(mission);
  for (std::size_t goal = 0; goal < goals_.size(); ++goal) {
    if (met[goal] == 0) continue;
    std::vector<std::uint32_t>& by = met_by_[goal];
    const auto at = std::lower_bound(by.begin(), by.end(), place);
    if (at == by.end() || *at != place) by.insert(at, place);
  }
}

std::array<GoalCount, goal_sections> CatalogCoverage::by_section() const {
  std::array<GoalCount, goal_sections> counts;
  for (std::size_t goal = 0; goal < goals_.size(); ++goal) {
    counts.at(static_cast<std::size_t>(section_of(goals_[goal].kind)))
        .add(is_met(goal), is_unreachable(goal));
  }
  return counts;
}

GoalCount CatalogCoverage::total() const {
  GoalCount count;
  for (std::size_t goal = 0; goal < goals_.size(); ++goal) {
    count.add(is_met(goal), is_unreachable(goal));
  }
  return count;
}

std::vector<std::vector<std::uint32_t>> CatalogCoverage::goals_of_lines() const {
  const auto ends = static_cast<std::size_t>(std::count(text_.begin(), text_.end(), '\n'));
  std::vector<std::vector<std::uint32_t>> of_lines(ends + 2);
  for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
    for (const std::uint32_t line : goals_[goal].lines) {
      if (line < of_lines.size()) of_lines[line].push_back(goal);
    }
  }
  return of_lines;
}

GoalCount Coverage::total() const {
  GoalCount count;
  for (const CatalogCoverage& catalog : catalogs) count.add(catalog.total());
  return count;
}

}  // namespace cbc
