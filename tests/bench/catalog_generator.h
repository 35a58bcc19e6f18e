#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace cbc::bench {

/// A family of artificial catalogs, each with one group: behaviors of a level require tasks of the
/// levels below it (a level with a higher number is a lower one), those of the lowest level
/// nothing. No task starts on request only. A task `empty` excludes every other task.
struct CatalogShape {
  std::size_t tasks = 0;         ///< T: tasks of a level
  std::size_t behaviors = 0;     ///< B: behaviors of a task
  std::size_t requirements = 0;  ///< R: tasks that a behavior requires
  std::size_t levels = 0;        ///< L
  std::size_t exclusions = 0;    ///< M: exclusivity lists for a level, and tasks of a list
  std::uint64_t seed = 0;        ///< of everything that is drawn
};

/// A catalog file. The same shape gives the same text everywhere.
///
/// No behavior requires a task that excludes its own. Where that leaves too few tasks for a list,
/// the list is shorter, or left out.
[[nodiscard]] std::string generate_catalog(const CatalogShape& shape);

}  // namespace cbc::bench
