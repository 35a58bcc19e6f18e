#include "cbc/loaded_catalog.h"

#include <utility>

#include "compiled/compiled_file.h"
#include "interface/content.h"

namespace cbc {
namespace {

std::string_view name_at(const Texts& names, std::uint32_t place) {
  return place < names.size() ? names[place] : std::string_view();
}

}  // namespace

CatalogLoading LoadedCatalog::load(const std::string& path) {
  CompiledFileResult result = load_compiled(path);
  if (!result.file) return {std::nullopt, std::move(result.error)};
  Content content{std::move(result.file->catalog)};
  return {LoadedCatalog(std::make_shared<const Content>(std::move(content))), {}};
}

LoadedCatalog::LoadedCatalog(std::shared_ptr<const Content> content)
    : content_(std::move(content)) {}

std::size_t LoadedCatalog::task_count() const { return content_->catalog.task_names.size(); }

std::size_t LoadedCatalog::behavior_count() const {
  return content_->catalog.behavior_names.size();
}

std::string_view LoadedCatalog::task_name(std::uint32_t place) const {
  return name_at(content_->catalog.task_names, place);
}

std::string_view LoadedCatalog::behavior_name(std::uint32_t place) const {
  return name_at(content_->catalog.behavior_names, place);
}

std::optional<std::uint32_t> LoadedCatalog::find_task(std::string_view name) const {
  return content_->catalog.find_task(name);
}

std::optional<std::uint32_t> LoadedCatalog::find_behavior(std::string_view name) const {
  return content_->catalog.find_behavior(name);
}

}  // namespace cbc
