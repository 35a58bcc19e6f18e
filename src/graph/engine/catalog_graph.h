#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "core/catalog/reader.h"
#include "core/catalog/situation.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "runtime/compiled/compiled_catalog.h"
#include "versions/difference/catalog_diff.h"

/// A catalog as a graph: what pictures of it are drawn from, with marks for what stands out (a
/// state, or the differences between two catalogs).
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

/// The presence, but keeps marks of a state, too: a behavior in use for one task may be of no use
/// to another one that it could perform.
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
    std::uint32_t group = none;             ///< none: it has no task
    std::vector<NamedCondition> situation;  ///< in which it fits
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
  std::vector<std::uint32_t> at_most;     ///< by list: how many of its tasks may run
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

/// The graph of a compiled catalog, which must outlive it.
[[nodiscard]] CatalogGraph to_graph(const CompiledCatalog& catalog);

/// The graph of a catalog that may have errors. What an error among the findings points at is
/// faulty, and so is everything on a cycle. `reading` must outlive the result.
[[nodiscard]] CatalogGraph to_graph(const CatalogReading& reading,
                                    const std::vector<Diagnostic>& findings);

/// The connected component of each task, then of each behavior, numbered in the order of their
/// first tasks. Uses only the links and lists of the graph.
[[nodiscard]] std::vector<std::uint32_t> components_of(const CatalogGraph& graph);

/// Fills in the arrays of neighbors from the others.
void connect(CatalogGraph& graph);

/// What runs after an event, and what the event changed. Tasks and behaviors are indices in the
/// catalog.
struct RunState {
  struct RunningTask {
    std::uint32_t task = 0;
    std::uint32_t behavior = 0;
    std::optional<std::int32_t> priority;  ///< of its request; 0: it started by itself
  };
  struct Change {
    std::uint32_t behavior = 0;
    bool is_activation = false;
    bool is_successful = true;
    bool is_undoing = false;  ///< rolls back an earlier change of the event
  };
  std::vector<RunningTask> running;
  std::vector<RunningTask> before;        ///< what ran before the event
  std::optional<std::uint32_t> finished;  ///< the active behavior whose end the event reports
  std::vector<Change> changes;            ///< in order
  /// A behavior that does not fit, since a situation variable has a value that it does not name.
  struct Misfit {
    std::uint32_t behavior = 0;
    std::string why;  ///< "LIGHT is dark"
  };
  std::vector<std::uint32_t> unavailable;  ///< fitting or not
  std::vector<Misfit> misfits;             ///< the others that do not fit
  std::vector<std::uint32_t> faulty;
};

/// Marks what is in use, and what came into use or went out of it with the event, and adds notes.
/// All else becomes faint. The graph is that of a valid catalog.
void mark_state(CatalogGraph& graph, const RunState& state);

/// Two catalogs as one: everything that the newer one has, and what only the older one has, with
/// marks and notes by `diff`, their comparison. Groups are those of the newer one; what it no
/// longer has is in the group of what it was connected with, or in none. The catalogs and `diff`
/// must outlive the result.
///
/// Exclusions that `diff` does not list are not marked.
[[nodiscard]] CatalogGraph to_graph(const CompiledCatalog& before, const CompiledCatalog& after,
                                    const CatalogDiff& diff);

}  // namespace cbc::draw
