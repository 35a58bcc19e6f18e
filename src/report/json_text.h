#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace cbc {

/// JSON on one line. Names may hold bytes that no JSON text can; they are replaced.
[[nodiscard]] std::string to_text(const nlohmann::ordered_json& json);

/// Appends an item of an array that has one item on a line, begun by `[`.
void append_item(std::string& array, const std::string& item);

}  // namespace cbc
