#pragma once

#include <cstddef>
#include <memory>
#include <pybind11/detail/common.h>
#include <pybind11/pybind11.h>
#include <vector>

#include "python/module/catalog.h"
#include "python/module/long_call.h"
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

/// A coordinator that any thread may use, one after the other.
struct PythonCoordinator {
  std::unique_ptr<Session> session;
  Turn turn;

  explicit PythonCoordinator(std::unique_ptr<Session> with) : session(std::move(with)) {}
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

/// An object whose __init__ was not called, or has failed: pybind11 would take memory without a
/// value for it.
template <typename Value>
void expect_initialized(const py::handle& object) {
  if (!py::isinstance<Value>(object)) return;
  auto* const instance = reinterpret_cast<py::detail::instance*>(object.ptr());
  if (instance->get_value_and_holder(py::detail::get_type_info(typeid(Value)))
          .holder_constructed()) {
    return;
  }
  const std::string name = py::str(py::type::of<Value>().attr("__name__"));
  throw py::type_error(name + ".__init__ was not called, or has failed");
}

/// For a class whose objects only the module makes: nobody can make one without a value.
inline void refuse_instances(const py::handle& type) {
  reinterpret_cast<PyTypeObject*>(type.ptr())->tp_new = [](PyTypeObject* of, PyObject*,
                                                           PyObject*) -> PyObject* {
    PyErr_Format(PyExc_TypeError, "cannot create '%s' objects", of->tp_name);
    return nullptr;
  };
}

}  // namespace cbc::python

namespace pybind11::detail {

template <>
struct type_caster<cbc::python::PythonCoordinator>
    : type_caster_base<cbc::python::PythonCoordinator> {
  bool load(handle source, bool convert) {
    cbc::python::expect_initialized<cbc::python::PythonCoordinator>(source);
    return type_caster_base<cbc::python::PythonCoordinator>::load(source, convert);
  }
};

template <>
struct type_caster<cbc::python::Catalog> : type_caster_base<cbc::python::Catalog> {
  bool load(handle source, bool convert) {
    cbc::python::expect_initialized<cbc::python::Catalog>(source);
    return type_caster_base<cbc::python::Catalog>::load(source, convert);
  }
};

template <>
struct type_caster<std::shared_ptr<cbc::python::Catalog>>
    : copyable_holder_caster<cbc::python::Catalog, std::shared_ptr<cbc::python::Catalog>> {
  bool load(handle source, bool convert) {
    cbc::python::expect_initialized<cbc::python::Catalog>(source);
    return copyable_holder_caster<cbc::python::Catalog,
                                  std::shared_ptr<cbc::python::Catalog>>::load(source, convert);
  }
};

}  // namespace pybind11::detail
