#include <string>
#include <utility>

#include "core/support/wording.h"
#include "python/module/bindings.h"
#include "python/module/catalog.h"
#include "python/module/errors.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::python {
namespace {

std::shared_ptr<const Catalog> load(std::string name, std::string path, std::string text) {
  CatalogLoading loading;
  {
    const py::gil_scoped_release release;
    loading = load_catalog(std::move(name), std::move(path), std::move(text));
  }
  if (loading.catalog == nullptr) raise_catalog_error(loading.findings, loading.error);
  return loading.catalog;
}

/// Python reads the file, so that what it cannot read is an OSError as everywhere.
std::shared_ptr<const Catalog> load_file(const py::object& file) {
  const py::module_ os = py::module_::import("os");
  const py::object path = os.attr("fsdecode")(file);
  if (py::cast<bool>(path.attr("__contains__")(py::str("\0", 1)))) {
    raise("UsageError", "expected a path, found a NUL character in it");
  }
  const py::bytes text = py::module_::import("pathlib").attr("Path")(path).attr("read_bytes")();
  const auto bytes = [&os](const py::object& of) {
    return py::cast<std::string>(os.attr("fsencode")(of));
  };
  return load(bytes(path), bytes(os.attr("path").attr("abspath")(path)), text);
}

std::shared_ptr<const Catalog> load_text(const py::object& text, const py::str& name) {
  return load(read_text(name, "name"), {}, read_text(text, "text"));
}

py::tuple names_of(const Texts& texts) { return make_tuple_of(texts, &to_str); }

py::dict tasks_of(const Catalog& catalog) {
  const CompiledCatalog& compiled = *catalog.compiled;
  py::dict tasks;
  for (const TaskId task : compiled.task_ids) {
    tasks[name_of_task(catalog, task)] = make_tuple_of(
        compiled.values[task],
        [&](const Value& value) { return name_of_behavior(catalog, value.behavior); });
  }
  return tasks;
}

py::dict variables_of(const Catalog& catalog) {
  const CompiledCatalog& compiled = *catalog.compiled;
  py::dict variables;
  for (std::uint32_t variable = 0; variable < compiled.variables.size(); ++variable) {
    py::tuple values(compiled.variables[variable].value_count);
    for (std::uint32_t place = 0; place < values.size(); ++place) {
      values[place] = to_python(compiled, {variable, place});
    }
    variables[to_str(compiled.name_of_variable(variable))] = values;
  }
  return variables;
}

std::string digest_of_catalog(const Catalog& catalog) {
  return to_hex(identity_of(*catalog.compiled));
}

}  // namespace

py::object to_python(const CompiledCatalog& catalog, VariableValue value) {
  const std::string_view word = catalog.name_of_value(value);
  if (catalog.variables[value.variable].is_boolean != 0) return py::bool_(word == "true");
  return to_str(word);
}

py::str name_of_task(const Catalog& catalog, TaskId task) {
  return to_str(catalog.compiled->name_of_task(task));
}

py::str name_of_behavior(const Catalog& catalog, BehaviorId behavior) {
  return to_str(catalog.compiled->name_of_behavior(behavior));
}

void bind_catalog(py::module_& module) {
  py::class_<Catalog, std::shared_ptr<Catalog>> type(
      module, "Catalog",
      "A catalog that can be used: Catalog(path), YAML or compiled.\n\n"
      "It never changes, and any number of coordinators and threads may use it.\n"
      "Raises CatalogError, with findings, if it has errors, and OSError if it cannot be read.");
  // pybind11 holds what is const as if it were not; nothing that is bound changes it.
  const auto held = [](const std::shared_ptr<const Catalog>& catalog) {
    return std::const_pointer_cast<Catalog>(catalog);
  };
  type.def(py::init([held](const py::object& path) { return held(load_file(path)); }),
           py::arg("path"));
  type.def_static(
      "from_text",
      [held](const py::object& text, const py::str& name) { return held(load_text(text, name)); },
      py::arg("text"), py::kw_only(), py::arg("name") = "<text>",
      "A catalog from its text (str, or bytes of a compiled one). `name` stands for the file in\n"
      "messages.");
  type.def_property_readonly(
      "name", [](const Catalog& catalog) { return to_str(catalog.name); },
      "The path as it was given, or the name of a text.");
  type.def_property_readonly(
      "path",
      [](const Catalog& catalog) -> py::object {
        if (catalog.path.empty()) return py::none();
        return py::module_::import("os").attr("fsdecode")(py::bytes(catalog.path));
      },
      "The absolute path of the file; None: it was made from a text.");
  type.def_property_readonly(
      "source", [](const Catalog& catalog) { return py::bytes(catalog.text); },
      "What was read: YAML or a compiled catalog.");
  type.def_property_readonly("tasks", &tasks_of,
                             "The tasks in catalog order, each with the behaviors that can perform "
                             "it, the most suitable first.");
  type.def_property_readonly(
      "behaviors",
      [](const Catalog& catalog) { return names_of(catalog.compiled->behavior_names); },
      "The behaviors in catalog order.");
  type.def_property_readonly("variables", &variables_of,
                             "The situation variables in catalog order, each with its values.");
  type.def_property_readonly(
      "findings", [](const Catalog& catalog) { return to_python(catalog.findings); },
      "What was found on loading, which is no error. lint() finds more.");
  type.def_property_readonly("digest", &digest_of_catalog,
                             "Of the meaning: equal for the YAML and the compiled catalog.");
  type.def("__eq__", [](const Catalog& one, const py::object& other) -> py::object {
    if (!py::isinstance<Catalog>(other)) {
      return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    }
    return py::bool_(digest_of_catalog(one) == digest_of_catalog(py::cast<const Catalog&>(other)));
  });
  type.def("__hash__",
           [](const Catalog& catalog) { return py::hash(py::str(digest_of_catalog(catalog))); });
  type.def("__repr__", [](const Catalog& catalog) {
    return to_str(concat("<Catalog ", quote(catalog.name), ": ",
                         quantity(catalog.compiled->tasks.size(), "task"), ", ",
                         quantity(catalog.compiled->behaviors.size(), "behavior"), ">"));
  });
  const auto itself = [](const py::object& catalog) { return catalog; };
  type.def("__copy__", itself);
  type.def("__deepcopy__", [](const py::object& catalog, const py::object&) { return catalog; });
  type.def(py::pickle(
      [](const Catalog& catalog) {
        return py::make_tuple(py::bytes(catalog.name), py::bytes(catalog.path),
                              py::bytes(catalog.text));
      },
      [held](const py::tuple& state) {
        if (state.size() != 3) raise("UsageError", "this is not the state of a Catalog");
        return held(load(read_text(state[0], "state"), read_text(state[1], "state"),
                         read_text(state[2], "state")));
      }));
}

}  // namespace cbc::python
