#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/reader.h"
#include "cbc/units.h"
#include "compile/compile.h"
#include "compiled/compiled_catalog.h"
#include "diagnostic/diagnostic.h"

/// A catalog as a graph: what pictures of it are drawn from.
namespace cbc::draw {

/// How something stands out.
enum class Mark : std::uint8_t {
  plain,
  faint,    ///< drawn only for its neighbors
  faulty,   ///< an error of the catalog
  added,    ///< of two catalogs, only the newer one has it
  removed,  ///< only the older one
  changed,  ///< both, with different attributes
  // Of a state. In use are tasks that run, active behaviors, and links between them; the rest is
  // faint.
  active,      ///< in use before and after the last event
  started,     ///< only after it
  stopped,     ///< only before it
  unavailable  ///< a behavior that could not be activated
};

/// The mark, in a state, of what is in use before the last event, and after it.
[[nodiscard]] Mark mark_of_use(bool was_in_use, bool is_in_use);

/// One mark for two things that are drawn as one. If the marks differ, faulty prevails, and others
/// make it changed. In a state, it is in use when one of the two is.
[[nodiscard]] Mark combine(Mark a, Mark b);

/// Keeps added and removed, and makes any other mark plain: what exists only through a thing shares
/// its presence, not its changes.
[[nodiscard]] Mark presence_of(Mark mark);

/// The same, but keeps marks of a state, too: a behavior in use for one task may be of no use to
/// another one that it could perform.
[[nodiscard]] Mark use_of(Mark mark);

/// The mark of what exists through both. Empty: neither of two catalogs has both. In a state, it is
/// in use when both are.
[[nodiscard]] std::optional<Mark> join(Mark a, Mark b);

/// The word for a mark; empty for one that does not stand out.
[[nodiscard]] std::string_view name_of(Mark mark);

/// What can be drawn of a catalog, valid or not. Tasks and behaviors have their indices in the
/// catalog; undefined tasks follow. Texts are views of the source of the graph.
///
/// A valid catalog and its compiled file give the same graph.
struct CatalogGraph {
  struct Task {
    std::string_view name;
    std::uint32_t group = 0;             ///< none: only an older catalog has it
    Millionths minimum_performance = 0;  ///< 0: none
    bool is_defined = true;
    std::optional<std::int32_t> priority;  ///< of its request, in a state
    Mark mark = Mark::plain;
    std::vector<std::string> notes;  ///< further lines
  };
  struct Behavior {
    std::string_view name;  ///< may be missing in a bad catalog
    std::string_view package;
    std::uint32_t group = none;  ///< none: it has no task
    Mark mark = Mark::plain;
    std::vector<std::string> notes;
  };
  struct Performance {
    std::uint32_t behavior = 0;
    std::uint32_t task = 0;
    Millionths suitability = one_million;
    Mark mark = Mark::plain;
    std::optional<Millionths> before;  ///< the suitability before a change
  };
  struct Requirement {
    std::uint32_t behavior = 0;
    std::uint32_t task = 0;
    Millionths minimum_performance = 0;  ///< 0: none
    Mark mark = Mark::plain;
    std::optional<Millionths> before;  ///< the minimum performance before a change
  };

  std::string_view file;
  std::vector<Task> tasks;
  std::vector<Behavior> behaviors;
  std::vector<Performance> performances;  ///< by behavior, then by task; pairs differ
  std::vector<Requirement> requirements;  ///< the same
  GrowingRows<std::uint32_t> exclusions;  ///< the tasks of each list, ascending; at least two
  /// By list, of each task. The exclusion of two tasks has their marks, joined; a list in which
  /// both are plain prevails over others.
  GrowingRows<Mark> exclusion_marks;

  // Indices in the arrays above: the neighbors of each task and behavior.
  GrowingRows<std::uint32_t> performances_of_task;
  GrowingRows<std::uint32_t> performances_of_behavior;
  GrowingRows<std::uint32_t> requirements_of_task;  ///< those of the task by behaviors
  GrowingRows<std::uint32_t> requirements_of_behavior;
  GrowingRows<std::uint32_t> exclusions_of_task;
};

/// `catalog` must outlive the result.
[[nodiscard]] CatalogGraph to_graph(const CompiledCatalog& catalog);

/// The same for a catalog that may have errors. What an error among the findings points at is
/// faulty, and so is everything on a cycle. `reading` must outlive the result.
[[nodiscard]] CatalogGraph to_graph(const CatalogReading& reading,
                                    const std::vector<Diagnostic>& findings);

/// The connected component of each task, then of each behavior, numbered in the order of their
/// first tasks. Uses only the links and lists of the graph.
[[nodiscard]] std::vector<std::uint32_t> components_of(const CatalogGraph& graph);

/// Fills in the arrays of neighbors from the others.
void connect(CatalogGraph& graph);

}  // namespace cbc::draw
