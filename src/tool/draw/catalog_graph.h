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

namespace cbc::draw {

/// How something stands out.
enum class Mark : std::uint8_t {
  plain,
  faint,    ///< it is here for what is next to it
  faulty,   ///< an error of the catalog
  added,    ///< of two catalogs, only the newer one has it
  removed,  ///< only the older one
  changed,  ///< both, and they say different things of it
  // Of a state. What is in use runs, is active, or is between what does; what is not is faint.
  active,      ///< in use before the last event and after it
  started,     ///< only after it
  stopped,     ///< only before it
  unavailable  ///< a behavior that could not be activated
};

/// The mark, in a state, of what was in use before the last event, and is after it.
[[nodiscard]] Mark mark_of_use(bool was_in_use, bool is_in_use);

/// The mark of what stands for both: the same; else of a fault, and of a change of any kind. In a
/// state it is in use when one of them is.
[[nodiscard]] Mark combine(Mark a, Mark b);

/// Added and removed as they are, anything else as plain: what does not carry over to what is there
/// through it.
[[nodiscard]] Mark presence_of(Mark mark);

/// The same, but for marks of a state, which are as they are: a behavior in use for one task may be
/// of no use to another one that it could perform.
[[nodiscard]] Mark use_of(Mark mark);

/// The mark of what is there through both. Empty: of two catalogs, none has both. In a state it is
/// in use when both are.
[[nodiscard]] std::optional<Mark> join(Mark a, Mark b);

/// The word for it; empty for what does not stand out.
[[nodiscard]] std::string_view name_of(Mark mark);

/// What a catalog has that can be drawn, good or bad. Places of tasks and behaviors are those in
/// the catalog, with the undefined tasks behind the others. Texts are views of what it was made of.
///
/// A good catalog and the compiled file of it give the same.
struct CatalogGraph {
  struct Task {
    std::string_view name;
    std::uint32_t group = 0;             ///< none: only an older catalog has it
    Millionths minimum_performance = 0;  ///< 0: none
    bool is_defined = true;
    std::optional<std::int32_t> priority;  ///< of its request, in a state
    Mark mark = Mark::plain;
    std::vector<std::string> notes;  ///< what is to be said of it beside the above
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
  /// Of each task of each list. Two tasks exclude one another as their marks, joined, say; if these
  /// are plain in one list, other lists say nothing.
  GrowingRows<Mark> exclusion_marks;

  // Places in the arrays above: what a task or a behavior has to do with.
  GrowingRows<std::uint32_t> performances_of_task;
  GrowingRows<std::uint32_t> performances_of_behavior;
  GrowingRows<std::uint32_t> requirements_of_task;  ///< those that ask for it
  GrowingRows<std::uint32_t> requirements_of_behavior;
  GrowingRows<std::uint32_t> exclusions_of_task;
};

/// `catalog` must outlive the result.
[[nodiscard]] CatalogGraph to_graph(const CompiledCatalog& catalog);

/// The same of a catalog that may have errors. What an error among the findings points at is
/// faulty, and so is all that is on a cycle. `reading` must outlive the result.
[[nodiscard]] CatalogGraph to_graph(const CatalogReading& reading,
                                    const std::vector<Diagnostic>& findings);

/// Which tasks and behaviors constraints connect: the number of the component of each task, then of
/// each behavior, counted by the first task of each. Needs no more than the links and the lists.
[[nodiscard]] std::vector<std::uint32_t> components_of(const CatalogGraph& graph);

/// Fills in what is next to what. The other arrays are complete.
void connect(CatalogGraph& graph);

}  // namespace cbc::draw
