#pragma once

#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"

// The exceptions of cbc_catalog, which are Python classes (cbc_catalog/_errors.py).

namespace cbc::python {

namespace py = pybind11;

/// `name`: "Error", "UsageError".
[[noreturn]] void raise(const char* name, const std::string& message);
[[noreturn]] void raise_type_error(const std::string& message);
[[noreturn]] void raise_unknown(const std::string& message, std::string_view name,
                                std::optional<std::string_view> nearest);
/// `message`: if there are no findings that say what is wrong.
[[noreturn]] void raise_catalog_error(const std::vector<Diagnostic>& findings,
                                      const std::string& message);

/// A list of Finding.
[[nodiscard]] py::list to_python(const std::vector<Diagnostic>& findings);

/// What a str (as UTF-8) or bytes has; `what` names anything else in a TypeError.
[[nodiscard]] std::string read_text(const py::handle& text, const char* what);

/// A text for Python. Bytes that are not UTF-8 are replaced.
[[nodiscard]] py::str to_str(std::string_view text);

}  // namespace cbc::python
