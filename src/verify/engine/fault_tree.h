#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"

// Why a task cannot run, as a fault tree: gates over faults of behaviors.

namespace cbc {

/// A Boolean function of which behaviors are faulty: true if no assignment that satisfies all
/// constraints runs a task without them. For every set of faults it says exactly this.
///
/// A task of which no exclusivity and no minimum performance matters is lost if all its behaviors
/// are, and a behavior is lost if it is faulty or a task that it requires is lost. For other tasks
/// behaviors cannot be chosen one by one, so these gates list the ways to run the task: choices of
/// behaviors that satisfy all constraints. A way is lost if one of its behaviors is faulty, or a
/// task of the first kind that these require is lost.
struct FaultTree {
  struct Node {
    enum class Kind : std::uint8_t {
      fault,     ///< of a behavior
      behavior,  ///< a behavior is lost
      task,      ///< a task is lost
      way        ///< a way to run the task is lost; counted from 0
    };
    Kind kind = Kind::fault;
    std::uint32_t number = 0;  ///< a BehaviorId, a TaskId, or that of the way

    auto operator<=>(const Node&) const = default;
  };
  /// True if all inputs are, or if any is.
  struct Gate {
    Node node;
    bool needs_all = false;
    std::vector<Node> inputs;  ///< distinct; at least one
  };

  TaskId task = 0;
  /// That of the task comes first. No gate: the task cannot run even without a fault.
  std::vector<Gate> gates;
  std::vector<BehaviorId> faults;  ///< all that occur, ascending
  std::size_t ways = 0;            ///< 0: no exclusivity and no minimum performance matters
};

/// Bounds of fault trees with ways: of all steps of their enumeration, and of all inputs of ways.
struct FaultTreeLimits {
  std::uint64_t steps = 10'000'000;
  std::uint64_t inputs = 1'000'000;
};

/// The fault tree of a task; `ruled_out`: behaviors that do not count, by BehaviorId. Or a sentence
/// that says why there is none: it would be too large.
[[nodiscard]] std::variant<FaultTree, std::string> make_fault_tree(
    const CompiledCatalog& catalog, TaskId task, const std::vector<bool>& ruled_out,
    const FaultTreeLimits& limits = {});

}  // namespace cbc
