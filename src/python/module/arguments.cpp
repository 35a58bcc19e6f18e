#include "python/module/arguments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/diagnostic/diagnostic.h"
#include "core/script/reader.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "python/module/errors.h"
#include "runtime/base/text.h"

namespace cbc::python {
namespace {

std::string type_of(const py::handle& value) { return std::string(Py_TYPE(value.ptr())->tp_name); }

[[noreturn]] void refuse_type(std::string_view what, std::string_view expected,
                              const py::handle& found) {
  raise_type_error(concat(what, ": expected ", expected, ", found ", type_of(found)));
}

std::vector<std::string_view> list_of(const Texts& texts) {
  std::vector<std::string_view> list;
  for (const std::string_view text : texts) list.push_back(text);
  return list;
}

/// `other`: what it is instead, or empty.
[[noreturn]] void refuse_name(std::string_view name, std::string_view kind, std::string_view other,
                              const std::vector<std::string_view>& known) {
  std::string message = concat("there is no ", kind, " ", quote(name));
  if (!other.empty()) message += concat(": it is a ", other);
  const auto near = nearest(name, known);
  message += did_you_mean(near);
  raise_unknown(message, name, near);
}

/// A dict, or another mapping as a dict.
py::dict read_mapping(const py::handle& mapping, std::string_view what) {
  if (PyDict_Check(mapping.ptr())) return py::reinterpret_borrow<py::dict>(mapping);
  const py::object type = py::module_::import("collections.abc").attr("Mapping");
  if (!py::isinstance(mapping, type)) refuse_type(what, "a mapping", mapping);
  return py::dict(py::reinterpret_borrow<py::object>(mapping));
}

}  // namespace

std::string read_name(const py::handle& name, std::string_view what) {
  if (!PyUnicode_Check(name.ptr())) refuse_type(what, "a str", name);
  Py_ssize_t size = 0;
  if (const char* const text = PyUnicode_AsUTF8AndSize(name.ptr(), &size)) {
    return {text, static_cast<std::size_t>(size)};
  }
  // Half a character, which no name of a catalog has.
  PyErr_Clear();
  return py::bytes(name.attr("encode")("utf-8", "replace"));
}

std::uint32_t read_task(const CompiledCatalog& catalog, const py::handle& name) {
  const std::string task = read_name(name, "task");
  if (const auto found = catalog.find_task(task)) return *found;
  refuse_name(task, "task", catalog.find_behavior(task) ? "behavior" : "",
              list_of(catalog.task_names));
}

std::uint32_t read_behavior(const CompiledCatalog& catalog, const py::handle& name) {
  const std::string behavior = read_name(name, "behavior");
  if (const auto found = catalog.find_behavior(behavior)) return *found;
  refuse_name(behavior, "behavior", catalog.find_task(behavior) ? "task" : "",
              list_of(catalog.behavior_names));
}

Subject read_subject(const CompiledCatalog& catalog, const py::handle& name) {
  const std::string subject = read_name(name, "behavior or task");
  if (const auto behavior = catalog.find_behavior(subject)) return {false, *behavior};
  if (const auto task = catalog.find_task(subject)) return {true, *task};
  std::vector<std::string_view> known = list_of(catalog.behavior_names);
  for (const std::string_view task : catalog.task_names) known.push_back(task);
  refuse_name(subject, "behavior or task", "", known);
}

Microseconds read_seconds(const py::handle& seconds, std::string_view what) {
  const bool is_number = PyNumber_Check(seconds.ptr()) != 0 && !PyBool_Check(seconds.ptr());
  if (!is_number) refuse_type(what, "seconds as a number", seconds);
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Float(seconds.ptr()));
  if (!number) {
    if (PyErr_ExceptionMatches(PyExc_OverflowError) == 0) throw py::error_already_set();
    PyErr_Clear();
  }
  const double value =
      number ? PyFloat_AS_DOUBLE(number.ptr()) : std::numeric_limits<double>::infinity();
  constexpr std::int64_t most_seconds = longest_time / second;
  const auto most = static_cast<double>(most_seconds);
  if (!(value >= 0 && value <= most)) {
    raise("UsageError", concat(what, ": expected 0 to ", longest_time / second, " seconds, found ",
                               std::string(py::str(seconds))));
  }
  return std::llround(value * static_cast<double>(second));
}

std::optional<Microseconds> read_time(const py::handle& seconds, Microseconds now) {
  if (seconds.is_none()) return std::nullopt;
  const Microseconds time = read_seconds(seconds, "time");
  if (time < now) {
    raise("UsageError",
          concat("time: expected ", format_decimal(now, 6), " s, which is now, or later, found ",
                 format_decimal(time, 6), " s; time never goes back"));
  }
  return time;
}

std::int64_t read_integer(const py::handle& number, std::string_view what, std::int64_t least,
                          std::int64_t most) {
  if (!PyLong_Check(number.ptr()) || PyBool_Check(number.ptr())) {
    refuse_type(what, "an int", number);
  }
  int overflow = 0;
  const long long value = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  if (overflow != 0 || value < least || value > most) {
    raise("UsageError",
          concat(what, ": expected an integer from ", least, " to ", most, ", found ",
                 overflow != 0 ? std::string("one of more than 63 bits") : std::to_string(value)));
  }
  return value;
}

FinishCause read_cause(const py::handle& cause) {
  const std::string word = read_name(cause, "cause");
  if (const auto found = find_word<FinishCause>(word)) return *found;
  const Words words = words_of<FinishCause>();
  raise("UsageError", concat("cause: expected ",
                             list_with_or(std::vector<std::string>(words.begin(), words.end())),
                             ", found ", quote(word), did_you_mean(nearest(word, words))));
}

std::optional<Parameters> read_parameters(const CompiledCatalog& catalog, std::uint32_t task,
                                          const py::handle& parameters) {
  if (parameters.is_none()) return std::nullopt;
  const py::dict mapping = read_mapping(parameters, "parameters");
  py::object text;
  try {
    text = py::module_::import("json").attr("dumps")(mapping, py::arg("allow_nan") = false);
  } catch (py::error_already_set& error) {
    if (error.matches(PyExc_ValueError) || error.matches(PyExc_RecursionError)) {
      raise("UsageError", concat("parameters: ", std::string(py::str(error.value()))));
    }
    throw;  // a TypeError that names the type
  }
  yaml::JsonReader reader;
  const auto json = py::cast<std::string>(text);
  const yaml::Node* const root = reader.read(json);
  if (root == nullptr) raise("UsageError", "parameters: " + reader.fault());
  Diagnostics diagnostics;
  Reporter reporter({}, diagnostics);
  std::optional<Parameters> read = cbc::read_parameters(*root, reporter);
  if (read) ParameterChecks(catalog, Severity::error).check(task, *root, reporter);
  if (!diagnostics.all().empty()) {
    raise("UsageError", diagnostics.all().front().message);
  }
  return read;
}

namespace {

std::uint32_t read_value(const CompiledCatalog& catalog, std::uint32_t variable,
                         const py::handle& value) {
  const bool is_boolean = catalog.variables[variable].is_boolean != 0;
  const std::string what = concat("situation variable ", quote(catalog.name_of_variable(variable)));
  std::string word;
  if (is_boolean) {
    if (!PyBool_Check(value.ptr())) refuse_type(what, "a bool", value);
    word = value.ptr() == Py_True ? "true" : "false";
  } else {
    word = read_name(value, what);
  }
  if (const auto found = catalog.find_value(variable, word)) return *found;
  std::vector<std::string_view> known;
  for (std::uint32_t place = 0; place < catalog.variables[variable].value_count; ++place) {
    known.push_back(catalog.name_of_value({variable, place}));
  }
  const auto near = nearest(word, known);
  raise_unknown(concat(what, " has no value ", quote(word), ", only ",
                       list_with_and(std::vector<std::string>(known.begin(), known.end())),
                       did_you_mean(near)),
                word, near);
}

void read_entry(const CompiledCatalog& catalog, const py::handle& key, const py::handle& value,
                Situation& situation) {
  const std::string name = read_name(key, "situation");
  if (const auto variable = catalog.find_variable(name)) {
    for (const VariableValue& other : situation.variables) {
      if (other.variable != *variable) continue;
      raise("UsageError", concat("situation: ", quote(name), " is given twice"));
    }
    situation.variables.push_back({*variable, read_value(catalog, *variable, value)});
    return;
  }
  if (const auto behavior = catalog.find_behavior(name)) {
    if (!PyBool_Check(value.ptr())) refuse_type(quote(name), "a bool: is it available?", value);
    situation.availability.push_back({*behavior, value.ptr() == Py_True});
    return;
  }
  std::vector<std::string_view> known = list_of(catalog.behavior_names);
  for (std::uint32_t place = 0; place < catalog.variables.size(); ++place) {
    known.push_back(catalog.name_of_variable(place));
  }
  refuse_name(name, "behavior or situation variable", catalog.find_task(name) ? "task" : "", known);
}

}  // namespace

void read_situation(const CompiledCatalog& catalog, const py::handle& values,
                    Situation& situation) {
  if (values.is_none()) return;
  for (const auto& [key, value] : read_mapping(values, "situation")) {
    read_entry(catalog, key, value, situation);
  }
}

}  // namespace cbc::python
