#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/yaml/document.h"

/// What the parts that read and write older catalogs share; see older_format.h.
namespace cbc::older {

inline constexpr std::string_view descriptor_sections[] = {"behavior_descriptors",
                                                           "basic_behaviors"};
inline constexpr std::string_view precedence_section = "precedence_constraints";
inline constexpr std::string_view system_key = "system";

/// Whether a section may have this value. A list of other values belongs to another program.
[[nodiscard]] bool is_list_of_entries(const yaml::Node& node);

/// Whether a behavior has a task, as in the present format.
[[nodiscard]] bool has_task(const yaml::Node& behavior);

/// A behavior of the present catalog and its task, which have one name.
struct Item {
  std::string name;
  std::uint32_t line = 0;  ///< in which it begins; 0: the older catalog has no entry for it
  const yaml::Node* timeout = nullptr;
  const yaml::Node* goal = nullptr;
  const yaml::Node* package = nullptr;
  std::optional<bool> is_reactive;
  bool is_capability = false;
  std::vector<std::string> required;
  std::vector<std::string> parameters;  ///< lines of the catalog
  std::vector<std::string> kept;        ///< "x-KEY: VALUE"
};

/// An older catalog in terms of the present format.
struct Converted {
  Item defaults;
  std::vector<Item> items;
  std::vector<std::vector<std::string>> exclusive;
  std::vector<std::string> kept_precedences;  ///< mappings
  std::vector<std::string> kept;              ///< "x-KEY: VALUE"
  std::set<std::uint32_t> other_lines;        ///< in which other entries than items begin
};

/// A scalar, or any value, as it may stand anywhere, also in brackets.
[[nodiscard]] std::string written(std::string_view text);
[[nodiscard]] std::string written(const yaml::Node& node);
/// Names as a list in brackets.
[[nodiscard]] std::string written(const std::vector<std::string>& names);

/// The catalog as a text with the comments of the older one, whose lines it ends as that does.
[[nodiscard]] std::string write(const Converted& catalog, const yaml::Document& document,
                                std::string_view text);

}  // namespace cbc::older
