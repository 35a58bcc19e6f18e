#pragma once

#include <cstddef>
#include <memory>
#include <pybind11/pybind11.h>
#include <vector>

#include "python/module/catalog.h"
#include "python/module/session.h"

// The classes of the module.

namespace cbc::python {

namespace py = pybind11;

void bind_catalog(py::module_& module);
/// Event, Change and StoppedTask.
void bind_events(py::module_& module);
/// Coordinator and Option.
void bind_coordinator(py::module_& module);
/// What the plugin for pytest needs.
void bind_test_files(py::module_& module);

/// An event for Python, with those of the same call. All of it is a copy that never changes.
struct PythonEvent {
  HandledEvent event;
  std::vector<std::shared_ptr<const PythonEvent>> before;
  std::vector<std::shared_ptr<const PythonEvent>> after;
};

/// The events of the clock before the event that was asked for, that event, and those after it.
[[nodiscard]] std::shared_ptr<const PythonEvent> make_event(std::vector<HandledEvent> events);
/// A tuple of events without others.
[[nodiscard]] py::tuple make_events(std::vector<HandledEvent> events);

template <typename Range, typename ToPython>
[[nodiscard]] py::tuple make_tuple_of(const Range& items, const ToPython& to_python) {
  py::tuple made(items.size());
  std::size_t place = 0;
  for (const auto& item : items) made[place++] = to_python(item);
  return made;
}

/// A value of a situation variable: bool or str.
[[nodiscard]] py::object to_python(const CompiledCatalog& catalog, VariableValue value);
[[nodiscard]] py::str name_of_task(const Catalog& catalog, TaskId task);
[[nodiscard]] py::str name_of_behavior(const Catalog& catalog, BehaviorId behavior);

}  // namespace cbc::python
