#pragma once

#include <string>

#include "catalog/catalog.h"
#include "catalog/draft.h"
#include "diagnostic/reporter.h"

namespace cbc {

/// Applies defaults to the attributes that tasks give themselves.
class TaskAttributes {
 public:
  /// `defaults` must outlive this object.
  TaskAttributes(const draft::TaskAttributes& defaults, Reporter& reporter)
      : defaults_(defaults), reporter_(reporter) {}

  /// Fills in a task from its entry, which stands at `range`. Reports both start flags at once.
  void apply(const Range& range, const draft::TaskAttributes& own, Task& task);

  /// What a later entry of a task changes, for people: "timeout 15 s, was 180 s". Empty if nothing.
  [[nodiscard]] std::string describe_changes(const draft::Task& before,
                                             const draft::Task& now) const;

 private:
  void report_both_flags(const Range& range, const draft::TaskAttributes& own, const Task& task);

  const draft::TaskAttributes& defaults_;
  Reporter& reporter_;
};

}  // namespace cbc
