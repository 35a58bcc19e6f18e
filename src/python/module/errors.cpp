#include "python/module/errors.h"

namespace cbc::python {
namespace {

py::object class_called(const char* name) {
  return py::module_::import("cbc_catalog._errors").attr(name);
}

[[noreturn]] void raise(const py::object& type, const py::object& exception) {
  PyErr_SetObject(type.ptr(), exception.ptr());
  throw py::error_already_set();
}

}  // namespace

void raise(const char* name, const std::string& message) {
  const py::object type = class_called(name);
  raise(type, type(to_str(message)));
}

void raise_type_error(const std::string& message) { throw py::type_error(message); }

void raise_unknown(const std::string& message, std::string_view name,
                   std::optional<std::string_view> nearest) {
  const py::object type = class_called("UnknownName");
  const py::object near = nearest ? py::object(to_str(*nearest)) : py::object(py::none());
  raise(type, type(to_str(message), to_str(name), near));
}

void raise_catalog_error(const std::vector<Diagnostic>& findings, const std::string& message) {
  const py::object type = class_called("CatalogError");
  raise(type, type(to_str(message), to_python(findings)));
}

py::list to_python(const std::vector<Diagnostic>& findings) {
  const py::object type = class_called("Finding");
  py::list list;
  for (const Diagnostic& finding : findings) {
    list.append(type(to_str(finding.file), finding.range.begin.line, finding.range.begin.column,
                     to_str(name_of(finding.severity)), to_str(finding.rule),
                     to_str(finding.message)));
  }
  return list;
}

std::string read_text(const py::handle& text, const char* what) {
  if (PyBytes_Check(text.ptr())) return py::reinterpret_borrow<py::bytes>(text);
  if (!PyUnicode_Check(text.ptr())) {
    raise_type_error(std::string(what) + ": expected a str or bytes, found " +
                     Py_TYPE(text.ptr())->tp_name);
  }
  // Half a character, which no file has, becomes a question mark.
  return py::reinterpret_borrow<py::bytes>(text.attr("encode")("utf-8", "replace"));
}

py::str to_str(std::string_view text) {
  PyObject* const made =
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
  if (made == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(made);
}

}  // namespace cbc::python
