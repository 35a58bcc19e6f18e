#pragma once

#include <cstdint>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <string_view>

#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "why/explanation.h"

// What Python passes, as the coordinator needs it. A wrong type raises TypeError, a name that the
// catalog lacks UnknownName, and another wrong value UsageError.

namespace cbc::python {

namespace py = pybind11;

/// A name; `what` says in messages of what.
[[nodiscard]] std::string read_name(const py::handle& name, std::string_view what);
[[nodiscard]] std::uint32_t read_task(const CompiledCatalog& catalog, const py::handle& name);
[[nodiscard]] std::uint32_t read_behavior(const CompiledCatalog& catalog, const py::handle& name);
/// A behavior, or else a task.
[[nodiscard]] Subject read_subject(const CompiledCatalog& catalog, const py::handle& name);

/// Seconds as any real number; `what` names them in messages.
[[nodiscard]] Microseconds read_seconds(const py::handle& seconds, std::string_view what);
/// None: empty.
[[nodiscard]] std::optional<Microseconds> read_time(const py::handle& seconds, Microseconds now);

[[nodiscard]] std::int64_t read_integer(const py::handle& number, std::string_view what,
                                        std::int64_t least, std::int64_t most);
[[nodiscard]] FinishCause read_cause(const py::handle& cause);

/// A mapping of texts to what JSON has.
[[nodiscard]] std::optional<Parameters> read_parameters(const CompiledCatalog& catalog,
                                                        std::uint32_t task,
                                                        const py::handle& parameters);

/// Adds the entries of a mapping of behaviors to booleans, and of situation variables to values.
void read_situation(const CompiledCatalog& catalog, const py::handle& values, Situation& situation);

}  // namespace cbc::python
