#include "explain/minimal_set.h"

#include <cstddef>

namespace cbc {
namespace {

/// Halves what may be left out (QuickXplain, Junker 2004): the reasons of `candidates` that are
/// needed beside `given` to leave no solution. `has_grown`: `given` has new reasons since it was
/// last found to leave a solution.
void minimize(const HasSolution& has_solution, std::vector<Reason>& given,
              std::span<const Reason> candidates, bool has_grown, std::vector<Reason>& needed) {
  if (has_grown && !has_solution(given)) return;
  if (candidates.size() == 1) {
    needed.push_back(candidates.front());
    return;
  }
  const std::span<const Reason> first = candidates.first(candidates.size() / 2);
  const std::span<const Reason> second = candidates.subspan(first.size());
  const std::size_t given_before = given.size();
  const std::size_t needed_before = needed.size();

  given.insert(given.end(), first.begin(), first.end());
  minimize(has_solution, given, second, true, needed);
  given.resize(given_before);

  given.insert(given.end(), needed.begin() + static_cast<std::ptrdiff_t>(needed_before),
               needed.end());
  minimize(has_solution, given, first, given.size() > given_before, needed);
  given.resize(given_before);
}

}  // namespace

std::vector<Reason> minimal_set(std::span<const Reason> candidates,
                                const HasSolution& has_solution) {
  std::vector<Reason> given;
  std::vector<Reason> needed;
  if (!candidates.empty()) minimize(has_solution, given, candidates, false, needed);
  return needed;
}

}  // namespace cbc
