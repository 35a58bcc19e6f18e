#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/diagnostic/diagnostic.h"
#include "core/files/output.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "core/yaml/json_value.h"
#include "runtime/base/text.h"
#include "schema_files.h"

namespace cbc::cli {
namespace {

/// A line that says what the schema describes.
std::string title_of(const EmbeddedFile& schema) {
  yaml::JsonReader reader;
  return yaml::JsonValue(*reader.read(schema.text))["title"].text();
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
  for (const EmbeddedFile& schema : schema_files) width = std::max(width, schema.name.size());
  const Style style = style_for(stdout);
  for (const EmbeddedFile& schema : schema_files) {
    fmt::print("{}{:<{}}{}  {}\n", style.strong, schema.name, width, style.reset, title_of(schema));
  }
  return exit_ok;
}

int print_schema(const std::string& name) {
  std::vector<std::string_view> names;
  for (const EmbeddedFile& schema : schema_files) {
    if (schema.name == name) {
      fmt::print("{}", schema.text);
      return exit_ok;
    }
    names.push_back(schema.name);
  }
  const std::string meant = did_you_mean(nearest(name, names));
  return usage_error("schema", "there is no schema {}{}", quote(name),
                     meant.empty() ? " ('cbc schema' lists them)" : meant);
}

}  // namespace

void add_schema_command(Program& program) {
  const auto name = std::make_shared<std::optional<std::string>>();
  Command& command = program.add_command("schema", "Prints the JSON Schema of a file of cbc.",
                                         {{"[NAME]"}, schema_examples, schema_footer});
  const auto names = [] {
    std::vector<NameWithHelp> all;
    for (const EmbeddedFile& schema : schema_files) {
      all.push_back({std::string(schema.name), title_of(schema)});
    }
    return all;
  };
  command.argument("NAME", *name, {"", "a schema", {}, names},
                   "The schema to print; without it, all are listed");
  command.action([name] { return *name ? print_schema(**name) : list_schemas(); });
}

}  // namespace cbc::cli
