#include "cli/schemas.h"

#include <nlohmann/json.hpp>

#include "schema_files.h"

namespace cbc::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string id_of(const Json& schema) { return schema.at("$id").get<std::string>(); }

/// Adds the schemas that a part of a schema refers to to `definitions`, by their ids, as well as
/// those that they refer to in turn.
void add_referenced(const Json& part, const std::string& own_id, Json& definitions) {
  if (part.is_object() && part.contains("$ref")) {
    const auto reference = part["$ref"].get<std::string>();
    const std::string id = reference.substr(0, reference.find('#'));
    if (!id.empty() && id != own_id && !definitions.contains(id)) {
      for (const Schema& schema : all_schemas()) {
        const Json other = Json::parse(schema.text);
        if (id_of(other) != id) continue;
        definitions[id] = other;
        add_referenced(other, own_id, definitions);
      }
    }
  }
  for (const Json& member : part) {
    if (member.is_structured()) add_referenced(member, own_id, definitions);
  }
}

}  // namespace

std::span<const Schema> all_schemas() { return schema_files; }

std::string title_of(const Schema& schema) {
  return Json::parse(schema.text).at("title").get<std::string>();
}

std::string standalone(const Schema& schema) {
  Json root = Json::parse(schema.text);
  Json definitions = Json::object();
  add_referenced(root, id_of(root), definitions);
  if (definitions.empty()) return std::string(schema.text);
  root["$defs"].update(definitions);
  return root.dump(2) + "\n";
}

}  // namespace cbc::cli
