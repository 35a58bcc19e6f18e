#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "explain/comparison.h"
#include "explain/configuration.h"
#include "explain/demand.h"
#include "solver/problem.h"
#include "solver/solver.h"

namespace cbc {

/// Finds the best solutions of a problem under demands, and the best of all, with a limit of effort
/// that does not depend on the clock.
class ConfigurationSearch {
 public:
  /// `ranks`: as for the solver that the answers are compared with. Outlived by both.
  ConfigurationSearch(const CompiledCatalog& catalog, const std::vector<std::uint32_t>& ranks);

  /// Takes up a problem, which must outlive its use. See Comparison for `elsewhere`.
  void load(const Problem& problem, const ObjectiveValues& elsewhere);

  /// The best solution of all that meet one of the `ways`; none if there is none. Meaningless where
  /// is_cut() says so.
  [[nodiscard]] std::optional<Configuration> find_best(std::span<const Demands> ways);

  /// The `count` best solutions, or all if there are fewer, `best` first. Where is_cut() says so,
  /// only as many as are certain.
  [[nodiscard]] std::vector<Configuration> list_best(const Assignment& best, std::size_t count);

  /// Whether the limit of effort came before the last answer was certain.
  [[nodiscard]] bool is_cut() const { return is_cut_; }

  [[nodiscard]] Comparison& comparison() { return comparison_; }

 private:
  /// A part of the problem, and its best solution.
  struct Part {
    Problem problem;
    Configuration best;
  };

  void begin();
  [[nodiscard]] std::optional<Configuration> solve(const Problem& part);
  void split(Part part, std::size_t most, std::vector<Part>& parts);
  void insert(Part part, std::size_t most, std::vector<Part>& parts);

  const CompiledCatalog& catalog_;
  Solver solver_;
  Comparison comparison_;
  const Problem* whole_ = nullptr;
  std::uint64_t effort_ = 0;
  bool is_cut_ = false;
};

}  // namespace cbc
