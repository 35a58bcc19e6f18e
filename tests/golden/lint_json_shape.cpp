#include "golden/lint_json_shape.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

namespace cbc::golden {
namespace {

using Json = nlohmann::ordered_json;
using Type = Json::value_t;

/// What a key's value is; one type, as all numbers here are counts or places.
struct Key {
  std::string name;
  Type type;
};
using Keys = std::vector<Key>;

constexpr Type a_text = Type::string;
constexpr Type a_number = Type::number_unsigned;
constexpr Type a_list = Type::array;
constexpr Type a_mapping = Type::object;

std::uint64_t number_of(const Json& object, const std::string& key) {
  return object[key].get<std::uint64_t>();
}

class ShapeCheck {
 public:
  void check_report(const Json& report) {
    if (!has_keys(report,
                  {{"schema", a_text},
                   {"files", a_list},
                   {"errors", a_number},
                   {"warnings", a_number},
                   {"notes", a_number}},
                  "the report")) {
      return;
    }
    if (report["schema"] != "cbc.lint/1") add("the schema is " + report["schema"].dump());
    for (const Json& file : report["files"]) check_file(file);
    for (const std::string severity : {"error", "warning", "note"}) {
      if (number_of(report, severity + "s") != found_[severity]) {
        add("the number of " + severity + "s is not that of the diagnostics");
      }
    }
  }

  [[nodiscard]] std::vector<std::string> take() { return std::move(faults_); }

 private:
  void check_file(const Json& file) {
    const bool is_understood =
        file.is_object() && file.contains("summary") && file["summary"].type() != Type::null;
    if (!has_keys(file,
                  {{"file", a_text},
                   {"diagnostics", a_list},
                   {"summary", is_understood ? a_mapping : Type::null}},
                  "a file")) {
      return;
    }
    const std::string where = file["file"].get<std::string>();
    std::pair<std::uint64_t, std::uint64_t> last;
    for (const Json& diagnostic : file["diagnostics"]) {
      if (!check_diagnostic(diagnostic, where)) continue;
      const std::pair place(number_of(diagnostic, "line"), number_of(diagnostic, "column"));
      if (place < last)
        add("the diagnostics of " + where + " are not in the order of their places");
      last = place;
    }
    if (is_understood) check_summary(file["summary"], where);
  }

  bool check_diagnostic(const Json& diagnostic, const std::string& file) {
    if (!has_keys(diagnostic,
                  {{"rule", a_text},
                   {"severity", a_text},
                   {"message", a_text},
                   {"line", a_number},
                   {"column", a_number},
                   {"end_line", a_number},
                   {"end_column", a_number},
                   {"related", a_list}},
                  "a diagnostic of " + file)) {
      return false;
    }
    const std::string where = "a diagnostic of " + file + " at line " + diagnostic["line"].dump();
    const std::string severity = diagnostic["severity"].get<std::string>();
    if (severity != "error" && severity != "warning" && severity != "note") {
      add(where + " has the severity '" + severity + "'");
    }
    ++found_[severity];
    check_name(diagnostic["rule"].get<std::string>(), where);
    const std::pair begin(number_of(diagnostic, "line"), number_of(diagnostic, "column"));
    const std::pair end(number_of(diagnostic, "end_line"), number_of(diagnostic, "end_column"));
    check_place(diagnostic, where);
    if (end < begin) add(where + " ends before it begins");
    if (diagnostic["message"] == "") add(where + " has no message");
    for (const Json& related : diagnostic["related"]) {
      if (has_keys(
              related,
              {{"file", a_text}, {"line", a_number}, {"column", a_number}, {"message", a_text}},
              "a place related to " + where)) {
        check_place(related, "a place related to " + where);
      }
    }
    return true;
  }

  void check_name(const std::string& rule, const std::string& where) {
    const bool is_name = !rule.empty() && std::all_of(rule.begin(), rule.end(), [](char byte) {
      return byte == '-' || (byte >= 'a' && byte <= 'z');
    });
    if (!is_name) add(where + " has the rule '" + rule + "'");
  }

  void check_place(const Json& object, const std::string& where) {
    if (object["line"] == 0U || object["column"] == 0U) add(where + " has a place of 0");
  }

  void check_summary(const Json& summary, const std::string& file) {
    const std::string where = "the summary of " + file;
    if (!has_keys(summary,
                  {{"tasks", a_number},
                   {"behaviors", a_number},
                   {"constraints", a_mapping},
                   {"groups", a_list},
                   {"search_space", a_text}},
                  where)) {
      return;
    }
    const Json& constraints = summary["constraints"];
    if (!has_keys(constraints,
                  {{"exclusive_pairs", a_number},
                   {"requirements", a_number},
                   {"task_minimums", a_number},
                   {"total", a_number}},
                  "the constraints of " + where)) {
      return;
    }
    if (number_of(constraints, "exclusive_pairs") + number_of(constraints, "requirements") +
            number_of(constraints, "task_minimums") !=
        number_of(constraints, "total")) {
      add("the constraints of " + where + " do not add up");
    }
    check_groups(summary, where);
    const std::string space = summary["search_space"].get<std::string>();
    const bool is_number = !space.empty() && space.front() != '0' &&
                           std::all_of(space.begin(), space.end(),
                                       [](char byte) { return byte >= '0' && byte <= '9'; });
    if (!is_number) add(where + " has the search space '" + space + "'");
  }

  /// Each task is in one group, each constraint within one.
  void check_groups(const Json& summary, const std::string& where) {
    std::uint64_t tasks = 0;
    std::uint64_t constraints = 0;
    std::map<std::string, int> times;
    for (const Json& group : summary["groups"]) {
      if (!has_keys(group, {{"tasks", a_list}, {"constraints", a_number}}, "a group of " + where)) {
        return;
      }
      tasks += group["tasks"].size();
      constraints += number_of(group, "constraints");
      for (const Json& task : group["tasks"]) ++times[task.dump()];
    }
    if (tasks != number_of(summary, "tasks") || times.size() != tasks) {
      add("the tasks of " + where + " are not those of its groups");
    }
    if (constraints != number_of(summary["constraints"], "total")) {
      add("the constraints of " + where + " are not those of its groups");
    }
  }

  static std::string describe(const Keys& keys) {
    std::string described;
    for (const Key& key : keys) {
      described +=
          (described.empty() ? "" : ", ") + key.name + " (" + Json(key.type).type_name() + ")";
    }
    return described;
  }

  bool has_keys(const Json& object, const Keys& expected, const std::string& where) {
    Keys found;
    if (object.is_object()) {
      for (const auto& [key, value] : object.items()) found.push_back({key, value.type()});
    }
    const bool is_equal =
        std::equal(found.begin(), found.end(), expected.begin(), expected.end(),
                   [](const Key& a, const Key& b) { return a.name == b.name && a.type == b.type; });
    if (!is_equal) {
      add(where + " must have the keys [" + describe(expected) + "], and has [" + describe(found) +
          "]");
    }
    return is_equal;
  }

  void add(std::string fault) { faults_.push_back(std::move(fault)); }

  std::map<std::string, std::uint64_t> found_;  ///< diagnostics by severity
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> find_lint_shape_faults(const std::string& text) {
  const Json report = Json::parse(text, nullptr, false);
  if (report.is_discarded()) return {"this is not JSON"};
  ShapeCheck check;
  check.check_report(report);
  return check.take();
}

}  // namespace cbc::golden
