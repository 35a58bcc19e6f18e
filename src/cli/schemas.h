#pragma once

#include <span>
#include <string>
#include <string_view>

/// The JSON Schemas of the folder schemas/, which are part of the program.
namespace cbc::cli {

struct Schema {
  std::string_view name;  ///< of its file, without the suffix
  std::string_view text;
};

/// In the order of their names.
[[nodiscard]] std::span<const Schema> all_schemas();

/// In one line, what the schema describes.
[[nodiscard]] std::string title_of(const Schema& schema);

/// The text of a schema that needs no other file: those that it refers to are part of it.
[[nodiscard]] std::string standalone(const Schema& schema);

}  // namespace cbc::cli
