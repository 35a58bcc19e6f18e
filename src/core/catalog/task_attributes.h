#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "core/catalog/catalog.h"
#include "core/diagnostic/diagnostic.h"

/// The attributes of tasks as a catalog gives them: by entries and by defaults. Only the reader of
/// catalogs uses this. Texts are views of the document.
namespace cbc {

struct Name {
  std::string_view text;
  Range range;
};

/// A value and where it stands.
template <typename T>
struct Placed {
  T value{};
  Range range;
};
using Flag = Placed<bool>;
using Percent = Placed<Millionths>;
using Timeout = Placed<Microseconds>;

/// Attributes of a task as an entry, or the defaults, give them.
struct GivenAttributes {
  std::optional<ExecutionGoal> execution_goal;
  std::optional<Flag> start_on_request;
  std::optional<Flag> reactive_start;
  std::optional<Timeout> timeout;
  std::optional<Placed<Improve>> improve;
  std::optional<Flag> resume;
  // Of entries alone.
  std::optional<Flag> requestable;
  std::optional<Placed<std::int32_t>> reactive_priority;
  bool is_unclear = false;       ///< one of them could not be read
  bool has_unknown_key = false;  ///< beside them
};

/// An entry of a task; a task may have several, of which the last one counts.
struct TaskEntry {
  Name name;
  GivenAttributes attributes;
  Percent minimum_performance;  ///< 0: none
  std::vector<Parameter> parameters;
  std::optional<Range> entry;  ///< where it begins, if all of it was understood
};

/// Completes the attributes of tasks with the defaults.
class TaskAttributes {
 public:
  /// `defaults` must outlive this object.
  TaskAttributes(const GivenAttributes& defaults, Reporter& reporter)
      : defaults_(defaults), reporter_(reporter) {}

  /// Fills in a task from its entry, which stands at `range`. Reports both start flags at once.
  void apply(const Range& range, const GivenAttributes& own, Task& task);

  /// What a later entry of a task changes, in words: "timeout 15 s, was 180 s". Empty if nothing.
  [[nodiscard]] std::string describe_changes(const TaskEntry& before, const TaskEntry& now) const;

 private:
  void report_both_flags(const Range& range, const GivenAttributes& own, const Task& task);
  void apply_rules(const GivenAttributes& own, Task& task);
  void report_rules(const GivenAttributes& own, const Task& task);

  const GivenAttributes& defaults_;
  Reporter& reporter_;
};

}  // namespace cbc
