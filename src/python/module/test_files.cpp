#include <string>
#include <utility>
#include <vector>

#include "core/files/file_set.h"
#include "core/property/properties.h"
#include "core/words/words.h"
#include "python/module/bindings.h"
#include "python/module/errors.h"
#include "runtime/base/text.h"

// What the plugin for pytest asks of files.

namespace cbc::python {
namespace {

/// "script", "properties", or "other", and whether it names its catalog.
py::tuple kind_of(const py::bytes& name, const py::bytes& text) {
  cli::FileSet files;
  const auto file = files.parse(name, text);
  const bool has_catalog = file->document != nullptr && cli::catalog_named_by(*file).has_value();
  const cli::FileKind kind = file->what.kind;
  return py::make_tuple(kind == cli::FileKind::script       ? "script"
                        : kind == cli::FileKind::properties ? "properties"
                                                            : "other",
                        has_catalog);
}

/// The line and the title of each property of a file.
std::vector<std::pair<std::size_t, std::string>> find_properties(const std::string& path,
                                                                 const std::string& catalog_path,
                                                                 cli::FileSet& files,
                                                                 bool& are_found) {
  const auto file = files.read(path);
  if (file == nullptr) return {};
  const auto named = cli::catalog_named_by(*file);
  const auto catalog = named ? files.load(*named) : files.load(catalog_path);
  if (catalog == nullptr) return {};
  const auto properties = files.read_properties(*file, *catalog->compiled);
  are_found = properties.has_value();
  if (!are_found) return {};
  std::vector<std::pair<std::size_t, std::string>> found;
  for (const Property& property : properties->properties) {
    found.emplace_back(property.line, property.name.empty()
                                          ? describe_property(*catalog->compiled, property)
                                          : property.name);
  }
  return found;
}

py::list list_properties(const py::bytes& path, const py::bytes& catalog) {
  cli::FileSet files;
  bool are_found = false;
  const auto found = find_properties(path, catalog, files, are_found);
  if (!are_found) {
    raise_catalog_error(files.findings(),
                        concat("the property file ", quote(std::string(path)), " cannot be used"));
  }
  py::list made;
  for (const auto& [line, title] : found) made.append(py::make_tuple(line, to_str(title)));
  return made;
}

}  // namespace

void bind_test_files(py::module_& module) {
  module.def("kind_of", &kind_of, py::arg("name"), py::arg("text"));
  module.def("list_properties", &list_properties, py::arg("path"), py::arg("catalog"),
             "`catalog`: its path, if the file names none.");
}

}  // namespace cbc::python
