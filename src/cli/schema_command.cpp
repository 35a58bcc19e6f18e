#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/input.h"
#include "cli/output.h"
#include "diagnostic/diagnostic.h"
#include "schema_files.h"
#include "support/wording.h"

namespace cbc::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string id_of(const Json& schema) { return schema.at("$id").get<std::string>(); }

/// Adds all schemas to `definitions`, by their ids, that a part of a schema refers to, directly or
/// through others.
void add_referenced(const Json& part, const std::string& own_id, Json& definitions) {
  if (part.is_object() && part.contains("$ref")) {
    const auto reference = part["$ref"].get<std::string>();
    const std::string id = reference.substr(0, reference.find('#'));
    if (!id.empty() && id != own_id && !definitions.contains(id)) {
      for (const Schema& schema : schema_files) {
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

/// A line that says what the schema describes.
std::string title_of(const Schema& schema) {
  return Json::parse(schema.text).at("title").get<std::string>();
}

/// The text of a schema, including the schemas that it refers to.
std::string standalone(const Schema& schema) {
  Json root = Json::parse(schema.text);
  Json definitions = Json::object();
  add_referenced(root, id_of(root), definitions);
  if (definitions.empty()) return std::string(schema.text);
  root["$defs"].update(definitions);
  return root.dump(2) + "\n";
}

constexpr const char* schema_examples =
    "  cbc schema                        all names, and what they describe\n"
    "  cbc schema catalog > catalog.json\n"
    "                                    for an editor that completes and checks YAML\n"
    "  cbc schema solve > solve.json     for programs that read its JSON\n";

constexpr const char* schema_footer =
    "The schemas are JSON Schema 2020-12. An editor with the YAML language server uses one for a "
    "file that begins with\n"
    "  # yaml-language-server: $schema=catalog.json\n"
    "\n"
    "Exit status: 0 the schema is printed, 2 there is none of this name, or the usage is wrong.\n"
    "\n"
    "Read more: man cbc";

int list_schemas() {
  std::size_t width = 0;
  for (const Schema& schema : schema_files) width = std::max(width, schema.name.size());
  const Style style = style_for(stdout);
  for (const Schema& schema : schema_files) {
    fmt::print("{}{:<{}}{}  {}\n", style.strong, schema.name, width, style.reset, title_of(schema));
  }
  return exit_ok;
}

int print_schema(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Schema& schema : schema_files) {
    if (schema.name == name) {
      fmt::print("{}", standalone(schema));
      return exit_ok;
    }
    names.push_back(schema.name);
  }
  const std::string meant = did_you_mean(nearest(name, names));
  return usage_error("schema", fmt::format("there is no schema {}{}", quote(name),
                                           meant.empty() ? " ('cbc schema' lists them)" : meant));
}

}  // namespace

void add_schema_command(Program& program) {
  const auto name = std::make_shared<std::optional<std::string>>();
  Command& command =
      program.add_command("schema", "Prints the JSON Schema of a file that cbc reads or writes.",
                          {{"[NAME]"}, schema_examples, schema_footer});
  Values names;
  names.expected = "a schema";
  names.names = [] {
    std::vector<NameWithHelp> all;
    for (const Schema& schema : schema_files) {
      all.push_back({std::string(schema.name), title_of(schema)});
    }
    return all;
  };
  command.argument("NAME", *name, names, "The schema to print; without it, all are listed");
  command.action([name] { return *name ? print_schema(**name) : list_schemas(); });
}

}  // namespace cbc::cli
