#include "core/support/json_description.h"

#include <stdexcept>

#include <nlohmann/json.hpp>

namespace cbc::json {
namespace {

using Json = nlohmann::ordered_json;

/// On one line, or if that is too long, each item and member on its own. `begin`: how much of the
/// line is taken.
std::string layout(const Json& value, std::size_t indent, std::size_t begin) {
  constexpr std::size_t widest_line = 100;
  if (!value.is_structured()) return value.dump();
  const auto put = [&](bool has_lines) {
    const std::string line_end = has_lines ? "\n" + std::string(indent + 2, ' ') : "";
    std::string laid_out(value.is_object() ? "{" : "[");
    for (auto part = value.begin(); part != value.end(); ++part) {
      if (part != value.begin()) laid_out += has_lines ? "," : ", ";
      const std::string key = value.is_object() ? Json(part.key()).dump() + ": " : "";
      laid_out += line_end + key;
      laid_out += layout(*part, indent + 2, has_lines ? indent + 2 + key.size() : 0);
    }
    if (has_lines) laid_out += "\n" + std::string(indent, ' ');
    return laid_out + (value.is_object() ? "}" : "]");
  };
  const std::string line = put(false);
  const bool fits = begin + line.size() < widest_line && line.find('\n') == std::string::npos;
  return fits ? line : put(true);
}

}  // namespace

void Definitions::add_text(std::string_view name, const std::string& definition) {
  for (const auto& [known, other] : texts_) {
    if (known != name) continue;
    if (other != definition) throw std::logic_error("two definitions of " + std::string(name));
    return;
  }
  texts_.emplace_back(name, definition);
}

std::string make_schema(std::string_view name, std::string_view title, std::string_view whole,
                        const Definitions& definitions) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"$id", "urn:cbc:schema:" + std::string(name) + ":1"},
                 {"title", title}};
  schema.update(Json::parse(whole));
  for (const auto& [part, definition] : definitions.texts())
    schema["$defs"][part] = Json::parse(definition);
  return layout(schema, 0, 0) + "\n";
}

}  // namespace cbc::json
