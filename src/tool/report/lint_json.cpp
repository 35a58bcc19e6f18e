#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cbc/version.h"
#include "diagnostic/rules.h"
#include "report/lint_report.h"
#include "support/json.h"
#include "support/wording.h"

namespace cbc {
namespace {

/// A text in which GitHub's runner finds neither the end of the line nor any of `separators`.
/// Control characters that it has no escape for are made printable.
std::string escape(std::string_view text, std::string_view separators) {
  std::string escaped;
  for (const char byte : text) {
    if (byte == '%' || byte == '\r' || byte == '\n' ||
        separators.find(byte) != std::string_view::npos) {
      escaped += fmt::format("%{:02X}", static_cast<unsigned char>(byte));
    } else {
      escaped += byte;
    }
  }
  return printable(escaped);
}

std::string escape_message(std::string_view text) { return escape(text, ""); }
std::string escape_property(std::string_view text) { return escape(text, ":,"); }

std::string describe_range(const Range& range) {
  return fmt::format(",line={},endLine={},col={},endColumn={}", range.begin.line, range.end.line,
                     range.begin.column, range.end.column);
}

/// GitHub attaches nothing to "./a.yaml", which is how a search in "." names a file.
std::string plain_path(const std::string& file) {
  return std::filesystem::path(file).lexically_normal().string();
}

}  // namespace

std::string github_command(std::string_view command, const GithubPlace& place,
                           std::string_view title, std::string_view message) {
  return fmt::format("::{} file={}{},title={}::{}\n", command,
                     escape_property(plain_path(place.file)),
                     place.range ? describe_range(*place.range) : "", escape_property(title),
                     escape_message(message));
}

namespace {

std::string_view command_of(Severity severity) {
  return severity == Severity::note ? "notice" : name_of(severity);
}

std::string message_of(const Diagnostic& finding) {
  std::string message = finding.message;
  for (const Note& note : finding.notes) {
    message += fmt::format("\n{}:{}:{}: {}", note.file, note.range.begin.line,
                           note.range.begin.column, note.message);
  }
  return message;
}

}  // namespace

std::string github_command_of(const Diagnostic& finding) {
  return github_command(command_of(finding.severity), {finding.file, finding.range},
                        fmt::format("cbc {}", finding.rule), message_of(finding));
}

std::string lint_github(const std::vector<LintedFile>& files) {
  std::string text;
  for (const LintedFile& file : files) {
    for (const Diagnostic& finding : file.findings) text += github_command_of(finding);
  }
  return text;
}

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Note& note) {
  return {{"file", note.file},
          {"line", note.range.begin.line},
          {"column", note.range.begin.column},
          {"message", note.message}};
}

Json to_json(const Diagnostic& finding) {
  Json related = Json::array();
  for (const Note& note : finding.notes) related.push_back(to_json(note));
  return {{"rule", finding.rule},
          {"severity", name_of(finding.severity)},
          {"message", finding.message},
          {"line", finding.range.begin.line},
          {"column", finding.range.begin.column},
          {"end_line", finding.range.end.line},
          {"end_column", finding.range.end.column},
          {"related", std::move(related)}};
}

Json to_json(const Summary& summary) {
  Json groups = Json::array();
  for (const Summary::Group& group : summary.groups) {
    groups.push_back({{"tasks", group.tasks}, {"constraints", group.constraints}});
  }
  return {{"tasks", summary.tasks},
          {"behaviors", summary.behaviors},
          {"constraints",
           {{"exclusive_pairs", summary.constraints.exclusive_pairs},
            {"requirements", summary.constraints.requirements},
            {"task_minimums", summary.constraints.task_minimums},
            {"total", summary.constraints.total()}}},
          {"groups", std::move(groups)},
          {"search_space", summary.search_space}};
}

std::string file_to_text(const LintedFile& file) {
  std::string text = "{\"file\":" + to_text(file.file) + ",\"diagnostics\":[";
  for (const Diagnostic& finding : file.findings) append_item(text, to_text(to_json(finding)));
  return text + "],\"summary\":" + (file.summary ? to_text(to_json(*file.summary)) : "null") + "}";
}

}  // namespace

std::string lint_json(const std::vector<LintedFile>& files) {
  std::string text = R"({"schema":"cbc.lint/1","files":[)";
  for (const LintedFile& file : files) append_item(text, file_to_text(file));
  text += "],\n\"errors\":" + std::to_string(count(files, Severity::error));
  text += ",\"warnings\":" + std::to_string(count(files, Severity::warning));
  text += ",\"notes\":" + std::to_string(count(files, Severity::note));
  return text + "}\n";
}

namespace {

std::string code(std::string_view text) { return fmt::format("```yaml\n{}```\n", text); }

}  // namespace

std::string rule_markdown(const Rule& rule) {
  std::string text =
      fmt::format("{}\n\n## Example\n\n{}\n## How to mend it\n\n{}\n\n{}", rule.explanation,
                  code(rule.example), rule.mending, code(rule.mended));
  if (rule.is_of_scripts) {
    text += fmt::format("\n## The catalog of these scripts\n\n{}", code(example_catalog()));
  }
  return text;
}

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view schema =
    "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";
constexpr std::string_view root = "%SRCROOT%";
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

Json message(std::string_view text) { return Json::object({{"text", text}}); }

Json rule_to_json(const Rule& rule) {
  const std::string_view tag = rule.is_of_scripts ? "event-script" : "catalog";
  return {{"id", rule.name},
          {"name", to_camel_case(rule.name)},
          {"shortDescription", message(rule.summary)},
          {"fullDescription", message(rule.explanation)},
          {"help", {{"text", rule_text(rule, plain_style())}, {"markdown", rule_markdown(rule)}}},
          {"defaultConfiguration", Json::object({{"level", name_of(rule.severity)}})},
          {"properties", Json::object({{"tags", Json::array({tag})}})}};
}

/// The tool with its rules, one on a line.
std::string tool() {
  std::string rules = "[";
  for (const Rule& rule : all_rules()) append_item(rules, to_text(rule_to_json(rule)));
  return R"({"driver":{"name":"cbc","version":)" + to_text(version) + R"(,"semanticVersion":)" +
         to_text(version) + R"(,"rules":)" + rules + "]}}";
}

Json to_region(const Range& range) {
  return {{"startLine", range.begin.line},
          {"startColumn", range.begin.column},
          {"endLine", range.end.line},
          {"endColumn", range.end.column}};
}

/// The parts of a run that depend on the files.
class Run {
 public:
  Run(std::string_view working_directory, bool is_complete)
      : directory_(fs::path(working_directory).lexically_normal()), is_complete_(is_complete) {}

  void add(const LintedFile& file) {
    const Json artifact = {{"location", locate(file.file)},
                           {"roles", Json::array({"analysisTarget"})}};
    const std::string text = to_text(artifact);
    if (known_artifacts_.insert(text).second) append_item(artifacts_, text);
    for (const Diagnostic& finding : file.findings) {
      append_item(results_, to_text(to_result(finding)));
    }
  }

  [[nodiscard]] std::string text() const {
    const Json invocation = Json::object({{"executionSuccessful", is_complete_}});
    return R"({"tool":)" + tool() + R"(,"invocations":[)" + to_text(invocation) +
           R"(],"artifacts":)" + artifacts_ + R"(],"columnKind":"unicodeCodePoints","results":)" +
           results_ + "]}";
  }

 private:
  static std::string to_file_uri(const fs::path& path) {
    return "file://" + percent_encode(path.native());
  }

  /// An artifactLocation.
  [[nodiscard]] Json locate(const std::string& file) const {
    if (file == standard_input) {
      return {{"uri", percent_encode(file)}, {"description", message("standard input")}};
    }
    const fs::path path = (directory_ / file).lexically_normal();
    const fs::path relative = path.lexically_relative(directory_);
    if (relative.empty() || *relative.begin() == "..") {
      return Json::object({{"uri", to_file_uri(path)}});
    }
    return {{"uri", percent_encode(relative.native())}, {"uriBaseId", root}};
  }

  [[nodiscard]] Json to_physical_location(const std::string& file, const Range& range) const {
    return {{"artifactLocation", locate(file)}, {"region", to_region(range)}};
  }

  Json to_result(const Diagnostic& finding) {
    const Json place = to_physical_location(finding.file, finding.range);
    Json result = {
        {"ruleId", finding.rule},
        {"ruleIndex", find_rule(finding.rule) - all_rules().data()},
        {"level", name_of(finding.severity)},
        {"message", message(finding.message)},
        {"locations", Json::array({Json::object({{"physicalLocation", place}})})},
        {"partialFingerprints",
         Json::object({{"cbcFinding/v1",
                        fingerprint_of(finding, to_text(place["artifactLocation"]["uri"]))}})}};
    std::size_t id = 0;
    for (const Note& note : finding.notes) {
      result["relatedLocations"].push_back(
          {{"id", ++id},
           {"physicalLocation", to_physical_location(note.file, note.range)},
           {"message", message(note.message)}});
    }
    return result;
  }

  /// Tells a finding from all others, wherever it moves to in its file.
  std::string fingerprint_of(const Diagnostic& finding, const std::string& uri) {
    const std::string identity = fmt::format("{}\n{}\n{}", finding.rule, uri, finding.message);
    const std::size_t index = times_seen_[identity]++;
    return fmt::format("{:016x}", fingerprint(fmt::format("{}\n{}", identity, index)));
  }

  const fs::path directory_;
  const bool is_complete_;
  std::set<std::string> known_artifacts_;
  std::map<std::string, std::size_t> times_seen_;
  std::string artifacts_ = "[";
  std::string results_ = "[";
};

}  // namespace

std::string lint_sarif(const std::vector<LintedFile>& files, std::string_view working_directory,
                       bool is_complete) {
  Run run(working_directory, is_complete);
  for (const LintedFile& file : files) run.add(file);
  return R"({"$schema":)" + to_text(schema) + R"(,"version":"2.1.0","runs":[)" + run.text() +
         "]}\n";
}

}  // namespace cbc
