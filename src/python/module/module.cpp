#include <pybind11/pybind11.h>

#include "cbc/version.h"
#include "python/module/bindings.h"

PYBIND11_MODULE(_native, module) {
  module.doc() = "The part of cbc_catalog that is in C++; use cbc_catalog.";
  cbc::python::bind_catalog(module);
  cbc::python::bind_events(module);
  cbc::python::bind_coordinator(module);
  cbc::python::bind_test_files(module);
  // People meet these classes as those of the package.
  for (const char* const name :
       {"Catalog", "Change", "StoppedTask", "Event", "Option", "Coordinator"}) {
    module.attr(name).attr("__module__") = "cbc_catalog";
  }
}
