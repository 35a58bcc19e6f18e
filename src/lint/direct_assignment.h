#pragma once

#include <cstdint>
#include <vector>

#include "compiled/compiled_catalog.h"

namespace cbc {

/// Finds assignments without search, which is enough for most values of most catalogs: what a value
/// requires runs with the first behavior that will do, and so on.
class DirectAssignment {
 public:
  explicit DirectAssignment(const CompiledCatalog& catalog);

  /// The values of an assignment that has a value and satisfies all constraints; valid until the
  /// next call. Empty if none is found in this way. `is_dead`, `is_live`: by value.
  [[nodiscard]] const std::vector<ValueId>& find(ValueId value, const std::vector<bool>& is_dead,
                                                 const std::vector<bool>& is_live);

 private:
  [[nodiscard]] bool take(ValueId value);
  [[nodiscard]] ValueId choose(TaskId task, const std::vector<bool>& is_dead,
                               const std::vector<bool>& is_live) const;

  const CompiledCatalog& catalog_;
  std::vector<ValueId> values_;
  std::uint64_t number_ = 0;            ///< of the present assignment
  std::vector<std::uint64_t> running_;  ///< by task: last assignment in which it runs
  std::vector<std::uint64_t> used_;     ///< by clique: last assignment in which a task of it runs
  std::uint64_t effort_left_;
};

}  // namespace cbc
