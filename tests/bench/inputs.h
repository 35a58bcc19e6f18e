#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/diagnostic/diagnostic.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc::bench {

/// A script and the catalog it runs on.
struct Mission {
  std::shared_ptr<const CompiledCatalog> catalog;
  Script script;
};

// All of these throw std::runtime_error if an input is not as it should be.

[[noreturn]] void refuse(const Diagnostics& diagnostics);

[[nodiscard]] std::shared_ptr<const CompiledCatalog> compile_text(std::string_view text,
                                                                  const std::string& name);

/// The mission `name` of catalogs/: the files name.yaml and name.mission.yaml.
[[nodiscard]] std::shared_ptr<const Mission> load_mission(const std::string& name);

/// A start of the task as the only event.
[[nodiscard]] std::shared_ptr<const Mission> mission_of_start(
    std::shared_ptr<const CompiledCatalog> catalog, std::string_view task);

}  // namespace cbc::bench
