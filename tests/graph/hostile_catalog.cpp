#include "graph/hostile_catalog.h"

#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "property/random.h"

namespace cbc::graph_test {
namespace {

struct Name {
  std::string text;
  std::string shown;
};

Name plain(const std::string& text) { return {text, text}; }

const std::vector<Name>& hostile_names() {
  static const std::vector<Name> names = [] {
    std::vector<Name> result{{"a\nb", "a\\nb"},     {"\n", "\\n"},
                             {"\t", "\\t"},         {"\x01", "\\x01"},
                             {"\r\n", "\\r\\n"},    {" ", "' '"},
                             {"   ", "'   '"},      {"\u202Eabc", "\\u202eabc"},
                             {"\uFFFE", "\\ufffe"}, {"\u00A0\u0085", "\u00A0\\x85"}};
    for (const char* const text :
         {"node",
          "edge",
          "graph",
          "digraph",
          "subgraph",
          "strict",
          "end",
          "default",
          "click",
          "style",
          "linkStyle",
          "classDef",
          "flowchart LR",
          "1abc",
          "42",
          "-3.5",
          "a\"b",
          "\"",
          "a\\",
          "\\",
          "\\\"",
          "\\N",
          "\\G",
          R"(\l\r\n)",
          "\\\\",
          "<b>bold</b>",
          "<",
          ">",
          "<<TABLE>>",
          "<br/>",
          "&amp;",
          "&lt;",
          "&#65;",
          "&#x41;",
          "a&b",
          "&",
          "#35;",
          "#quot;",
          "#",
          "a#2",
          "a:b:c",
          "a:n",
          ":",
          "x|y",
          "{a|b}",
          "{",
          "[x]",
          "([x])",
          "(x)",
          "((x))",
          "ünïcödé",
          "Ünİ",
          "任務",
          "🚁",
          "e\u0301",
          " a",
          "a ",
          "a b",
          "%",
          "%%",
          "%20",
          "%5C",
          "%%{init: {}}%%",
          "`x`",
          "\"`x`\"",
          "**bold**",
          "_x_",
          "__x__",
          "1. x",
          "- x",
          "+ x",
          "> x",
          "# x",
          "~~~x~~~",
          "https://x.org/a",
          "www.x.org",
          "-->",
          "A-->B",
          "---",
          "a;b",
          "a,b",
          "'",
          "''",
          "a",
          "o",
          "x",
          "~",
          "$",
          "$$x$$",
          "@{ shape: x }",
          ":::x",
          "==>",
          "task:HOVER",
          "task_HOVER",
          "behavior",
          "null",
          "true",
          "*",
          "!",
          "a.b",
          "a-b",
          "_",
          "__",
          "fa:fa-ban",
          "href",
          "call",
          "\\u0041",
          "{{x}}",
          "/x/",
          "é",
          "</text>",
          "<!--",
          "]]>",
          ("a_very_long_name_that_is_broken_into_several_lines_and_TakesCamelCaseAsWell.or-other/"
           "ones"),
          "averyverylongnamewithoutanyplaceatwhichitcouldbebrokenintoseverallineswithoutharm"}) {
      result.push_back(plain(text));
    }
    return result;
  }();
  return names;
}

class Generator {
  struct Variable {
    Name name;
    std::vector<Name> values;  // empty: declared without values
  };

 public:
  explicit Generator(std::uint64_t seed)
      : random_(seed), is_bad_(random_.percent(50)), names_(hostile_names()) {
    random_.shuffle(names_);
  }

  HostileCatalog run() && {
    const std::size_t tasks = 1 + random_.below(7);
    for (std::size_t i = 0; i < tasks; ++i) add_task();
    for (std::size_t more = random_.below(3); more > 0; --more) add_variable();
    for (std::size_t i = 0; i < tasks; ++i) add_behavior(i);
    for (std::size_t more = random_.below(5); more > 0; --more) add_behavior(random_.below(tasks));
    add_exclusivity();
    if (is_bad_) add_undefined_task();
    catalog_.edges += pairs_.size();
    catalog_.text = nlohmann::ordered_json{
        {"situation", situation_},
        {"tasks", tasks_},
        {"behaviors", behaviors_},
        {"exclusivity_constraints",
         exclusivity_}}.dump();
    return std::move(catalog_);
  }

 private:
  Name draw_name() {
    Name name = names_.back();
    names_.pop_back();
    return name;
  }

  /// One that a condition can be read with.
  Name draw_visible_name() {
    Name name = draw_name();
    while (name.shown.starts_with("' ")) name = draw_name();
    return name;
  }

  void add_variable() {
    Variable variable{draw_visible_name(), {}};
    nlohmann::ordered_json entry{{"variable", variable.name.text}};
    if (random_.percent(70)) {
      for (int i = 0; i < 3; ++i) {
        variable.values.push_back(draw_visible_name());
        entry["values"].push_back(variable.values.back().text);
      }
    }
    situation_.push_back(std::move(entry));
    variables_.push_back(std::move(variable));
  }

  /// Adds a condition on a variable to a behavior, and returns what is shown of it.
  std::string add_condition(const Variable& variable, nlohmann::ordered_json& behavior) {
    nlohmann::ordered_json& condition = behavior["situation"][variable.name.text];
    if (variable.values.empty()) {
      condition = random_.percent(50);
      return (condition.get<bool>() ? "" : "not ") + variable.name.shown;
    }
    const std::size_t first = random_.below(3);
    condition.push_back(variable.values[first].text);
    std::string shown = variable.name.shown + ": " + variable.values[first].shown;
    if (first < 2 && random_.percent(50)) {
      condition.push_back(variable.values[2].text);
      shown += ", " + variable.values[2].shown;
    }
    return shown;
  }

  void add_task() {
    const Name name = draw_name();
    std::string note;
    nlohmann::ordered_json task{{"task", name.text}};
    if (random_.percent(30)) {
      task["minimum_performance"] = 1;
      note = "≥ 1 %";
    }
    tasks_.push_back(std::move(task));
    task_names_.push_back(name.text);
    catalog_.labels.push_back(name.shown + note);
  }

  // A good catalog has requirements of later tasks only, so that there is no cycle.
  void add_behavior(std::size_t task) {
    // A task and a behavior may have the same name.
    const Name name = draw_name();
    nlohmann::ordered_json behavior{{"behavior", name.text},
                                    {"package", hostile_names()[random_.below(20)].text},
                                    {"task", task_names_[task]},
                                    {"suitability", 50 + random_.below(51)}};
    nlohmann::ordered_json required = nlohmann::ordered_json::array();
    for (std::size_t other = is_bad_ ? 0 : task + 1; other < task_names_.size(); ++other) {
      if (random_.percent(60)) continue;
      required.push_back(
          {{"task", task_names_[other]}, {"minimum_performance", random_.below(50)}});
      ++catalog_.edges;
    }
    behavior["requires"] = std::move(required);
    std::string label = name.shown;
    for (const Variable& variable : variables_) {
      if (random_.percent(50)) label += add_condition(variable, behavior);
    }
    behaviors_.push_back(std::move(behavior));
    catalog_.labels.push_back(std::move(label));
    ++catalog_.edges;
  }

  // Without behaviors that require anything, they break nothing.
  void add_exclusivity() {
    for (std::size_t lists = random_.below(4); lists > 0; --lists) {
      std::vector<std::size_t> members;
      nlohmann::ordered_json list = nlohmann::ordered_json::array();
      for (std::size_t task = 0; task < task_names_.size(); ++task) {
        if (random_.percent(40)) continue;
        for (const std::size_t before : members) pairs_.emplace(before, task);
        members.push_back(task);
        list.push_back(task_names_[task]);
      }
      exclusivity_.push_back({{"mutually_exclusive", std::move(list)}});
    }
  }

  void add_undefined_task() {
    const Name name = draw_name();
    behaviors_[0]["requires"].push_back({{"task", name.text}});
    catalog_.labels.push_back(name.shown + "not defined");
    ++catalog_.edges;
  }

  oracle::Random random_;
  bool is_bad_;
  std::vector<Name> names_;
  std::vector<std::string> task_names_;
  std::vector<Variable> variables_;
  nlohmann::ordered_json situation_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json tasks_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json behaviors_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json exclusivity_ = nlohmann::ordered_json::array();
  std::set<std::pair<std::size_t, std::size_t>> pairs_;
  HostileCatalog catalog_;
};

}  // namespace

HostileCatalog hostile_catalog(std::uint64_t seed) { return Generator(seed).run(); }

}  // namespace cbc::graph_test
