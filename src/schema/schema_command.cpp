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

std::string member_of(const EmbeddedFile& schema, std::string_view name) {
  yaml::JsonReader reader;
  return yaml::JsonValue(*reader.read(schema.text))[name].text();
}

std::string id_of(const EmbeddedFile& schema) { return member_of(schema, "$id"); }

/// A line that says what the schema describes.
std::string title_of(const EmbeddedFile& schema) { return member_of(schema, "title"); }

/// The other schemas that this one refers to, directly or through others.
std::vector<const EmbeddedFile*> referenced_by(const EmbeddedFile& schema) {
  std::vector<const EmbeddedFile*> found = {&schema};
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const EmbeddedFile& other : schema_files) {
      const std::string reference = R"("$ref": ")" + id_of(other);
      if (found[i]->text.find(reference) != std::string_view::npos &&
          std::find(found.begin(), found.end(), &other) == found.end()) {
        found.push_back(&other);
      }
    }
  }
  found.erase(found.begin());
  return found;
}

/// The text of a schema, including the schemas that it refers to: they become the first of its
/// "$defs", by their ids.
std::string standalone(const EmbeddedFile& schema) {
  constexpr std::string_view definitions = "\n  \"$defs\": {";
  std::string text(schema.text);
  for (const EmbeddedFile* other : referenced_by(schema)) {
    std::string definition = fmt::format("\n\"{}\": {}", id_of(*other), other->text);
    definition.back() = ',';  // in place of the last line end
    for (std::size_t at = 0; (at = definition.find('\n', at)) != std::string::npos; ++at) {
      definition.insert(at + 1, "    ");
    }
    text.insert(text.find(definitions) + definitions.size(), definition);
  }
  return text;
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
      fmt::print("{}", standalone(schema));
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
  Command& command =
      program.add_command("schema", "Prints the JSON Schema of a file that cbc reads or writes.",
                          {{"[NAME]"}, schema_examples, schema_footer});
  Values names;
  names.expected = "a schema";
  names.names = [] {
    std::vector<NameWithHelp> all;
    for (const EmbeddedFile& schema : schema_files) {
      all.push_back({std::string(schema.name), title_of(schema)});
    }
    return all;
  };
  command.argument("NAME", *name, names, "The schema to print; without it, all are listed");
  command.action([name] { return *name ? print_schema(**name) : list_schemas(); });
}

}  // namespace cbc::cli
