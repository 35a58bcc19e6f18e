#include "cli/file_kind.h"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace cbc::cli {
namespace {

constexpr std::array<std::string_view, 4> catalog_keys = {
    "behaviors", "tasks", "exclusivity_constraints", "default_values"};

template <typename Keys>
bool has_any(const yaml::Document& document, const Keys& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&](std::string_view key) { return document.root().find(key) != nullptr; });
}

}  // namespace

bool is_catalog(const yaml::Document& document) { return has_any(document, catalog_keys); }

bool is_script(const yaml::Document& document) {
  constexpr std::array<std::string_view, 4> keys = {"events", "catalog", "reactive_delay",
                                                    "situation"};
  return document.root().kind == yaml::Kind::sequence ||
         (!is_catalog(document) && has_any(document, keys));
}

bool looks_like_catalog(std::string_view text) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
    for (const std::string_view key : catalog_keys) {
      if (line.starts_with(key) && line.substr(key.size()).starts_with(':')) return true;
    }
    begin += line.size() + 1;
  }
  return false;
}

}  // namespace cbc::cli
