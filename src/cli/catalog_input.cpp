#include "cli/catalog_input.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "cli/input.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

/// Whether there is a compiled catalog in a regular file: nothing else can be read twice.
bool can_be_mapped(const std::string& path) {
  std::error_code ignored;
  if (path == "-" || !std::filesystem::is_regular_file(path, ignored)) return false;
  std::array<char, 8> begin{};
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), begin.size());
  return is_compiled({begin.data(), static_cast<std::size_t>(file.gcount())});
}

}  // namespace

std::optional<CatalogInput> read_catalog_input(const std::string& path) {
  if (can_be_mapped(path)) return CatalogInput{path, {}, true};
  std::optional<std::string> content = read_input(path);
  if (!content) return std::nullopt;
  const bool has_catalog = is_compiled(*content);
  return CatalogInput{path, std::move(*content), has_catalog};
}

std::optional<CompiledFile> load(const CatalogInput& input) {
  CompiledFileResult result =
      input.content.empty() ? load_compiled(input.path) : read_compiled(input.content);
  if (!result.file) {
    complain(fmt::format("cannot read {}: {}", quote(display_name(input.path)), result.error));
  }
  return std::move(result.file);
}

}  // namespace cbc::cli
