#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "cbc/version.h"
#include "core/compile/catalog_json.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/support/json.h"
#include "core/support/json_description.h"
#include "core/support/wording.h"
#include "lint/report/lint_report.h"
#include "runtime/base/text.h"

namespace cbc {
namespace json::lint {

constexpr auto related = object(
    "related", "", member("file", any_text, "", &Note::file),
    member("line", line_number, "", [](const Note& note) { return note.range.begin.line; }),
    member("column", line_number, "", [](const Note& note) { return note.range.begin.column; }),
    member("message", text, "The message, for people.", &Note::message));

constexpr auto diagnostic = object(
    "diagnostic",
    "A finding and the text that it is about: from `line` and `column` up to, but not including, "
    "`end_line` and `end_column`. Lines and columns count from 1; columns count characters, not "
    "bytes.",
    member("rule", matching("^[a-z]+(-[a-z]+)*$"),
           "The rule; `cbc lint --list-rules` lists them. Later versions may have more.",
           &Diagnostic::rule),
    member("severity", words(Severity::error),
           "error: the file cannot be used. warning: the meaning is clear, but probably not "
           "intended. note: advice.",
           &Diagnostic::severity),
    member("message", text, "The message, for people.", &Diagnostic::message),
    member("line", line_number, "", [](const Diagnostic& of) { return of.range.begin.line; }),
    member("column", line_number, "", [](const Diagnostic& of) { return of.range.begin.column; }),
    member("end_line", line_number, "", [](const Diagnostic& of) { return of.range.end.line; }),
    member("end_column", line_number, "", [](const Diagnostic& of) { return of.range.end.column; }),
    member("related", list(related), "Related places.", &Diagnostic::notes));

constexpr auto group_of_tasks = object(
    "group", "",
    member("tasks", texts.at_least(1).unique(), "In catalog order.", &CatalogNumbers::task_names),
    member("constraints", count, "Number of constraints between them.",
           [](const CatalogNumbers& group) { return group.constraints.total(); }));

constexpr auto total = [](const LintedFile& file) -> const CatalogNumbers& {
  return file.summary->total;
};

constexpr auto summary = object(
    "summary", "",
    member("tasks", count, "", [](const LintedFile& file) { return total(file).tasks; }),
    member("behaviors", count, "", [](const LintedFile& file) { return total(file).behaviors; }),
    member("constraints", constraints, "",
           [](const LintedFile& file) { return total(file).constraints; }),
    member(
        "groups", list(group_of_tasks),
        "Sets of tasks that constraints connect, ordered by their first task.",
        [](const LintedFile& file) -> const auto& { return file.summary->groups; }),
    part(total, group(search_space)));

constexpr auto linted_file = object(
    "file", "", member("file", any_text, "The file, as given.", &LintedFile::file),
    member("diagnostics", list(diagnostic).on_lines(),
           "The findings, in the order of their positions.", &LintedFile::findings),
    member(
        "summary", nullable(summary),
        "The catalog in numbers; null for an event script, a settings file, or if the file could "
        "not be understood.",
        [](const LintedFile& file) { return file.summary ? &file : nullptr; }));

template <Severity severity>
constexpr auto count_of =
    [](const std::vector<LintedFile>& files) { return cbc::count(files, severity); };

constexpr auto report = object(
    "", "The output of `cbc lint --format json` (schema cbc.lint/1).", schema_member("cbc.lint/1"),
    member("files", list(linted_file).on_lines(),
           "The files that were checked, in order; files that cannot be read are not included. A "
           "settings file is included, at the end, if there are findings about it.",
           std::identity()),
    member("errors", count, "Number in all files.", count_of<Severity::error>).on_line(),
    member("warnings", count, "Number in all files.", count_of<Severity::warning>),
    member("notes", count, "Number in all files.", count_of<Severity::note>));

}  // namespace json::lint

std::string lint_json(const std::vector<LintedFile>& files) {
  return json::document(json::lint::report, files);
}

std::string lint_schema() { return json::schema("lint", "Output of cbc lint", json::lint::report); }

std::string rule_markdown(const Rule& rule) {
  const auto code = [](std::string_view text) { return fmt::format("```yaml\n{}```\n", text); };
  std::string text =
      fmt::format("{}\n\n## Example\n\n{}\n## How to fix it\n\n{}\n\n{}", rule.explanation,
                  code(rule.example), rule.mending, code(rule.mended));
  if (!rule.settings.empty()) {
    text += fmt::format("\n## The settings of the example\n\n{}", code(rule.settings));
  }
  if (rule.is_of_scripts) {
    text += fmt::format("\n## The catalog of these scripts\n\n{}", code(example_catalog()));
  }
  return text;
}

namespace {

namespace fs = std::filesystem;

constexpr std::string_view schema =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";
constexpr std::string_view sources_root = "%SRCROOT%";
constexpr std::string_view standard_input = "<stdin>";

/// "dead-behavior" as "DeadBehavior".
std::string to_camel_case(std::string_view name) {
  std::string result;
  bool begins_word = true;
  for (const char letter : name) {
    if (letter == '-') {
      begins_word = true;
      continue;
    }
    result += begins_word ? static_cast<char>(letter - 'a' + 'A') : letter;
    begins_word = false;
  }
  return result;
}

void write_rule(JsonWriter& json, const Rule& rule) {
  json.on_new_line().open('{');
  json.write("id", rule.name);
  json.write("name", to_camel_case(rule.name));
  json.write_object("shortDescription", {{"text", rule.summary}});
  json.write_object("fullDescription", {{"text", rule.explanation}});
  json.write_object("help",
                    {{"text", rule_text(rule, plain_style())}, {"markdown", rule_markdown(rule)}});
  json.write_object("defaultConfiguration", {{"level", name_of(rule.severity)}});
  json.open("properties", '{');
  json.write_list("tags", std::array{rule.is_of_scripts ? "event-script" : "catalog"});
  json.close('}');
  json.close('}');
}

void write_tool(JsonWriter& json) {
  json.open("tool", '{');
  json.open("driver", '{');
  json.write_members({{"name", "cbc"}, {"version", version}, {"semanticVersion", version}});
  json.write_list("rules", all_rules(), [&](const Rule& rule) { write_rule(json, rule); });
  json.close('}');
  json.close('}');
}

/// FNV-1a of 64 bits. It must never change: services that collect findings recognize them by it.
constexpr std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : text) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3;
  }
  return hash;
}
static_assert(hash_of("foobar") == 0x85944171f73967e8);

/// Where a file lies, relative to the working directory if it is below it.
struct FileUri {
  std::string uri;
  bool is_relative = false;
  bool is_standard_input = false;
};

/// Writes the only run of a SARIF log.
class SarifRun {
 public:
  SarifRun(JsonWriter& json, std::string_view working_directory)
      : json_(json), directory_(fs::path(working_directory).lexically_normal()) {}

  void write(const std::vector<LintedFile>& files, bool is_complete) {
    json_.open('{');
    write_tool(json_);
    json_.open("invocations", '[');
    json_.write_object({{"executionSuccessful", is_complete}});
    json_.close(']');
    json_.write_list("artifacts", files,
                     [&](const LintedFile& file) { write_artifact(file.file); });
    json_.write("columnKind", "unicodeCodePoints");
    json_.open("results", '[');
    for (const LintedFile& file : files) {
      for (const Diagnostic& finding : file.findings) write_result(finding);
    }
    json_.close(']');
    json_.close('}');
  }

 private:
  [[nodiscard]] FileUri locate(const std::string& file) const {
    if (file == standard_input) return {percent_encode(file), false, true};
    const fs::path path = (directory_ / file).lexically_normal();
    const fs::path relative = path.lexically_relative(directory_);
    if (relative.empty() || *relative.begin() == "..") {
      return {"file://" + percent_encode(path.native())};
    }
    return {percent_encode(relative.native()), true};
  }

  void write_location(std::string_view name, const FileUri& place) {
    json_.open(name, '{');
    json_.write("uri", place.uri);
    if (place.is_relative) json_.write("uriBaseId", sources_root);
    if (place.is_standard_input) json_.write_object("description", {{"text", "standard input"}});
    json_.close('}');
  }

  void write_artifact(const std::string& file) {
    const FileUri place = locate(file);
    if (!known_artifacts_.insert(place.uri).second) return;
    json_.on_new_line().open('{');
    write_location("location", place);
    json_.write_list("roles", std::array{"analysisTarget"});
    json_.close('}');
  }

  void write_physical_location(const std::string& file, const Range& range) {
    json_.open("physicalLocation", '{');
    write_location("artifactLocation", locate(file));
    json_.write_object("region", {{"startLine", range.begin.line},
                                  {"startColumn", range.begin.column},
                                  {"endLine", range.end.line},
                                  {"endColumn", range.end.column}});
    json_.close('}');
  }

  void write_result(const Diagnostic& finding) {
    json_.on_new_line().open('{');
    json_.write("ruleId", finding.rule);
    json_.write("ruleIndex", find_rule(finding.rule) - all_rules().data());
    json_.write("level", name_of(finding.severity));
    json_.write_object("message", {{"text", finding.message}});
    json_.open("locations", '[');
    json_.open('{');
    write_physical_location(finding.file, finding.range);
    json_.close('}');
    json_.close(']');
    json_.write_object("partialFingerprints", {{"cbcFinding/v1", fingerprint_of(finding)}});
    if (!finding.notes.empty()) write_related(finding.notes);
    json_.close('}');
  }

  void write_related(const std::vector<Note>& notes) {
    std::size_t id = 0;
    json_.write_list("relatedLocations", notes, [&](const Note& note) {
      json_.open('{');
      json_.write("id", ++id);
      write_physical_location(note.file, note.range);
      json_.write_object("message", {{"text", note.message}});
      json_.close('}');
    });
  }

  /// Identifies a finding, even if it moves to another line of its file.
  std::string fingerprint_of(const Diagnostic& finding) {
    std::string uri;
    append_text(uri, locate(finding.file).uri);
    const std::string identity = fmt::format("{}\n{}\n{}", finding.rule, uri, finding.message);
    const std::size_t index = times_seen_[identity]++;
    return fmt::format("{:016x}", hash_of(fmt::format("{}\n{}", identity, index)));
  }

  JsonWriter& json_;
  const fs::path directory_;
  std::set<std::string> known_artifacts_;
  std::map<std::string, std::size_t> times_seen_;
};

}  // namespace

std::string lint_sarif(const std::vector<LintedFile>& files, std::string_view working_directory,
                       bool is_complete) {
  return json_line([&](JsonWriter& json) {
    json.write_members({{"$schema", schema}, {"version", "2.1.0"}});
    json.open("runs", '[');
    SarifRun(json, working_directory).write(files, is_complete);
    json.close(']');
  });
}

std::span<const LintFormat> lint_formats() {
  using Files = const std::vector<LintedFile>&;
  using Run = const LintRun&;
  static constexpr LintFormat formats[] = {
      {"text",
       [](Files files, Run run) { return lint_text(files, run.style, run.not_understood); }},
      {"json", [](Files files, Run /*run*/) { return lint_json(files); }},
      {"sarif", [](Files files,
                   Run run) { return lint_sarif(files, run.working_directory, run.is_complete); }},
      {"github", [](Files files, Run /*run*/) { return lint_github(files); }},
      {"gcc", [](Files files, Run /*run*/) { return lint_gcc(files); }},
  };
  return formats;
}

}  // namespace cbc
