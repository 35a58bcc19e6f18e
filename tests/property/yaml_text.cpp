#include "yaml_text.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace cbc::oracle {
namespace {

struct Entry;

struct Node {
  enum class Kind { null, plain, text, sequence, mapping };

  Kind kind = Kind::null;
  std::string text;  // of plain (a number or boolean) and text
  std::vector<Node> items;
  std::vector<Entry> entries;

  void add(Node item);
  void add(const std::string& key, Node value);
};

struct Entry {
  std::string key;
  Node value;
};

void Node::add(Node item) { items.push_back(std::move(item)); }
void Node::add(const std::string& key, Node value) { entries.push_back({key, std::move(value)}); }

Node scalar(Node::Kind kind, std::string text) {
  Node node;
  node.kind = kind;
  node.text = std::move(text);
  return node;
}

Node empty(Node::Kind kind) {
  Node node;
  node.kind = kind;
  return node;
}

Node null() { return empty(Node::Kind::null); }
Node plain(std::string value) { return scalar(Node::Kind::plain, std::move(value)); }
Node text(std::string value) { return scalar(Node::Kind::text, std::move(value)); }
Node sequence() { return empty(Node::Kind::sequence); }
Node mapping() { return empty(Node::Kind::mapping); }

bool is_number(const std::string& value) {
  return std::all_of(value.begin(), value.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Writes a tree in block style with some parts in flow style, or all of it as JSON.
class Printer {
 public:
  Printer(Random& random, bool as_json) : random_(random), json_(as_json) {}

  std::string print(const Node& node) {
    return json_ || inline_only(node) ? flow(node) + "\n" : block(node, 0);
  }

 private:
  static bool inline_only(const Node& node) { return node.items.empty() && node.entries.empty(); }

  static std::size_t weight(const Node& node) {
    std::size_t total = 1;
    for (const Node& item : node.items) {
      total += weight(item);
    }
    for (const auto& [key, value] : node.entries) {
      total += weight(value);
    }
    return total;
  }

  bool choose_flow(const Node& node) {
    return inline_only(node) || (weight(node) < 12 && random_.percent(20));
  }

  std::string flow_scalar(const Node& node) {
    switch (node.kind) {
      case Node::Kind::null:
        return json_ || random_.percent(50) ? "null" : "~";
      case Node::Kind::text: {
        if (json_) {
          return is_number(node.text) && random_.percent(50) ? node.text : '"' + node.text + '"';
        }
        const std::size_t way = random_.below(100);
        return way < 80 ? node.text : way < 90 ? '"' + node.text + '"' : '\'' + node.text + '\'';
      }
      default:
        return node.text;
    }
  }

  std::string flow(const Node& node) {
    if (node.kind == Node::Kind::sequence) {
      std::string result;
      for (const Node& item : node.items) {
        result += (result.empty() ? "" : ", ") + flow(item);
      }
      return "[" + result + "]";
    }
    if (node.kind == Node::Kind::mapping) {
      std::string result;
      for (const auto& [key, value] : node.entries) {
        const std::string written = json_ ? '"' + key + '"' : key;
        result += (result.empty() ? "" : ", ") + written + ": " + flow(value);
      }
      return "{" + result + "}";
    }
    return flow_scalar(node);
  }

  // Lines that begin with `indent` spaces.
  std::string block(const Node& node, std::size_t indent) {
    const std::string margin(indent, ' ');
    std::string result;
    for (const Node& item : node.items) {
      if (choose_flow(item)) {
        result += margin + "- " + flow(item);
        result += comment() + "\n";
        continue;
      }
      std::string lines = block(item, indent + 2);
      lines[indent] = '-';
      result += lines;
    }
    for (const auto& [key, value] : node.entries) {
      if (value.kind == Node::Kind::null && random_.percent(50)) {
        result += margin + key + ":" + comment() + "\n";
      } else if (choose_flow(value)) {
        result += margin + key + ": " + flow(value);
        result += comment() + "\n";
      } else {
        // A sequence may stand at the margin of its key.
        const bool at_margin = value.kind == Node::Kind::sequence && random_.percent(60);
        result += margin + key + ":" + comment() + "\n";
        result += block(value, at_margin ? indent : indent + 2);
      }
    }
    return result;
  }

  std::string comment() { return random_.percent(2) ? "  # a remark" : ""; }

  Random& random_;
  bool json_;
};

// What the writers of catalogs and of scripts share.
class Writer {
 public:
  Writer(Random& random, bool as_json) : random_(random), json_(as_json) {}

 protected:
  Node boolean(bool value) {
    if (json_) {
      return plain(value ? "true" : "false");
    }
    static const std::vector<std::string> yes = {"TRUE", "true", "True", "yes",
                                                 "Yes",  "YES",  "on",   "TRUE"};
    static const std::vector<std::string> no = {"FALSE", "false", "False", "no",
                                                "No",    "NO",    "off",   "FALSE"};
    return plain(random_.pick(value ? yes : no));
  }

  // The value of a situation variable.
  Node value_of(const Variable& variable, std::size_t value) {
    if (!variable.is_boolean()) {
      return text(variable.values[value]);
    }
    Node node = boolean(value == 0);
    if (random_.percent(25)) {
      node.text = '"' + node.text + '"';
    }
    return node;
  }

  // A decimal number with the given number of places, some or all of its last zeros left out.
  Node decimal(std::int64_t value, std::size_t places) {
    std::string digits = std::to_string(value);
    if (digits.size() <= places) {
      digits.insert(0, places + 1 - digits.size(), '0');
    }
    std::string fraction = digits.substr(digits.size() - places);
    const std::string whole = digits.substr(0, digits.size() - places);
    const bool keep_one = random_.percent(10);
    const bool keep_all = random_.percent(5);
    while (!keep_all && !fraction.empty() && fraction.back() == '0') {
      fraction.pop_back();
    }
    if (fraction.empty() && keep_one) {
      fraction = "0";
    }
    return plain(fraction.empty() ? whole : whole + "." + fraction);
  }

  Node percentage(Millionths value) { return decimal(value, 4); }
  Node seconds(Microseconds value) { return decimal(value, 6); }

  Random& random_;
  bool json_;
};

class CatalogWriter : public Writer {
 public:
  CatalogWriter(const Catalog& catalog, Random& random, bool as_json)
      : Writer(random, as_json),
        catalog_(catalog),
        chance_of_old_names_(random.percent(40)   ? 60
                             : random.percent(30) ? 10
                                                  : 0),
        chance_of_noise_(random.percent(50) ? 15 : 0) {}

  Node write() {
    std::vector<Entry> sections;
    add_defaults(sections);
    sections.push_back({"behaviors", behaviors()});
    if (!catalog_.variables.empty()) {
      sections.push_back({"situation", variables()});
    } else if (noise()) {
      sections.push_back({"situation", null()});
    }
    Node listed = tasks();
    if (!listed.items.empty()) {
      sections.push_back({"tasks", std::move(listed)});
    } else if (random_.percent(30)) {
      sections.push_back({"tasks", null()});
    }
    Node lists = exclusivity();
    if (!lists.items.empty() || random_.percent(10)) {
      sections.push_back({"exclusivity_constraints", std::move(lists)});
    } else if (random_.percent(10)) {
      sections.push_back({"exclusivity_constraints", null()});
    }
    if (noise()) {
      sections.push_back({"x-author", text("nobody")});
    }
    if (random_.percent(50)) {
      random_.shuffle(sections);
    }
    Node root = mapping();
    root.entries = std::move(sections);
    return root;
  }

 private:
  bool noise() { return random_.percent(chance_of_noise_); }
  bool old_name() { return random_.percent(chance_of_old_names_); }

  void add_start_on_request(Node& node, bool value) {
    if (old_name()) {
      node.add("automatic_activation", boolean(!value));
    } else {
      node.add("start_on_request", boolean(value));
    }
  }

  void add_reactive_start(Node& node, bool value) {
    const char* key = old_name() ? "default" : "reactive_start";
    node.add(key, boolean(value));
  }

  void add_goal(Node& node, bool keep_running) {
    if (old_name()) {
      node.add("category", text(keep_running ? "recurrent" : "goal_based"));
    } else {
      node.add("execution_goal", text(keep_running ? "keep_running" : "achieve_goal"));
    }
  }

  void add_suitability(Node& node, Millionths value) {
    const char* key = old_name() ? "efficacy" : "suitability";
    node.add(key, percentage(value));
  }

  // A key with a null value is as if it were absent.
  void add_null_sometimes(Node& node, const char* key) {
    if (noise()) {
      node.add(key, null());
    }
  }

  void add_defaults(std::vector<Entry>& sections) {
    const Defaults& defaults = catalog_.defaults;
    Node tasks = mapping();
    if (defaults.keep_running) {
      add_goal(tasks, *defaults.keep_running);
    } else {
      add_null_sometimes(tasks, "execution_goal");
    }
    if (defaults.start_on_request) {
      add_start_on_request(tasks, *defaults.start_on_request);
    }
    if (defaults.reactive_start) {
      add_reactive_start(tasks, *defaults.reactive_start);
    }
    if (defaults.timeout) {
      tasks.add("timeout", seconds(*defaults.timeout));
    } else {
      add_null_sometimes(tasks, "timeout");
    }
    Node behaviors = mapping();
    if (defaults.suitability) {
      add_suitability(behaviors, *defaults.suitability);
    } else {
      add_null_sometimes(behaviors, "suitability");
    }
    if (noise()) {
      behaviors.add("package", text("common"));
    }
    if (tasks.entries.empty() && behaviors.entries.empty()) {
      if (random_.percent(10)) {
        sections.push_back({"default_values", null()});
      }
      return;
    }

    const bool as_list = random_.percent(60);
    Node root = as_list ? sequence() : mapping();
    const auto add_part = [&](const char* key, Node part) {
      if (part.entries.empty()) {
        return;
      }
      if (!as_list) {
        root.add(key, std::move(part));
        return;
      }
      Node list = sequence();
      list.add(std::move(part));
      Node entry = mapping();
      entry.add(key, std::move(list));
      root.add(std::move(entry));
    };
    add_part("tasks", std::move(tasks));
    add_part("behaviors", std::move(behaviors));
    sections.push_back({"default_values", std::move(root)});
  }

  Node tasks() {
    Node list = sequence();
    for (const Task& task : catalog_.tasks) {
      if (task.listed) {
        list.add(task_entry(task));
      }
    }
    return list;
  }

  Node task_entry(const Task& task) {
    const Defaults& defaults = catalog_.defaults;
    Node node = mapping();
    node.add("task", text(task.name));

    const bool says_reactive =
        task.reactive_start != defaults.reactive_start.value_or(false) || random_.percent(25);
    if (says_reactive) {
      add_reactive_start(node, task.reactive_start);
    }
    const bool otherwise_on_request =
        !(says_reactive && task.reactive_start) && defaults.start_on_request.value_or(true);
    if (task.start_on_request != otherwise_on_request || random_.percent(25)) {
      add_start_on_request(node, task.start_on_request);
    } else {
      add_null_sometimes(node, "start_on_request");
    }
    if (task.keep_running != defaults.keep_running.value_or(false) || random_.percent(25)) {
      add_goal(node, task.keep_running);
    } else {
      add_null_sometimes(node, "execution_goal");
    }
    if (task.timeout && (task.timeout != defaults.timeout || random_.percent(25))) {
      node.add("timeout", seconds(*task.timeout));
    } else {
      add_null_sometimes(node, "timeout");
    }
    if (task.minimum != 0 || random_.percent(4)) {
      node.add("minimum_performance", percentage(task.minimum));
    } else {
      add_null_sometimes(node, "minimum_performance");
    }
    if (!task.requestable) {
      node.add("requestable", plain("false"));
    }
    if (task.reactive_priority != 0) {
      node.add("reactive_priority", plain(std::to_string(task.reactive_priority)));
    }
    if (task.improve != Improve::at_events) {
      node.add("improve", text(task.improve == Improve::at_once ? "at_once" : "when_started"));
    }
    if (task.resume) {
      node.add("resume", plain("true"));
    }
    if (noise()) {
      node.add("parameters", declared_parameters());
    } else {
      add_null_sometimes(node, "parameters");
    }
    if (noise()) {
      node.add("x-color", text("green"));
    }
    if (random_.percent(15)) {
      random_.shuffle(node.entries);
    }
    return node;
  }

  static Node declared_parameters() {
    Node list = sequence();
    for (const char* name : {"p", "q"}) {
      Node parameter = mapping();
      parameter.add("parameter", text(name));
      list.add(std::move(parameter));
    }
    return list;
  }

  Node behaviors() {
    Node list = sequence();
    for (const Behavior& behavior : catalog_.behaviors) {
      list.add(behavior_entry(behavior));
    }
    return list;
  }

  Node behavior_entry(const Behavior& behavior) {
    Node node = mapping();
    node.add("behavior", text(behavior.name));
    if (random_.percent(30)) {
      node.add("package", noise() ? null() : text("motion_control"));
    }
    add_performed(node, behavior);
    if (behavior.timeout) {
      node.add("timeout", seconds(*behavior.timeout));
    } else {
      add_null_sometimes(node, "timeout");
    }
    if (!behavior.requirements.empty()) {
      Node list = sequence();
      for (const Requirement& requirement : behavior.requirements) {
        Node entry = mapping();
        entry.add("task", text(catalog_.tasks[requirement.task].name));
        if (requirement.minimum != 0 || random_.percent(4)) {
          entry.add("minimum_performance", percentage(requirement.minimum));
        } else {
          add_null_sometimes(entry, "minimum_performance");
        }
        list.add(std::move(entry));
      }
      node.add("requires", std::move(list));
    } else if (noise()) {
      node.add("requires", random_.percent(50) ? null() : sequence());
    }
    add_situation(node, behavior);
    if (behavior.retry != Retry::at_events) {
      node.add("retry",
               text(behavior.retry == Retry::when_started ? "when_started" : "after_repair"));
    }
    if (noise()) {
      node.add("x-since", plain("2"));
    }
    if (random_.percent(15)) {
      random_.shuffle(node.entries);
    }
    return node;
  }

  Node variables() {
    Node list = sequence();
    for (const Variable& variable : catalog_.variables) {
      Node entry = mapping();
      entry.add("variable", text(variable.name));
      if (!variable.is_boolean()) {
        Node values = sequence();
        for (const std::string& value : variable.values) {
          values.add(text(value));
        }
        entry.add("values", std::move(values));
      } else {
        add_null_sometimes(entry, "values");
      }
      list.add(std::move(entry));
    }
    return list;
  }

  void add_situation(Node& node, const Behavior& behavior) {
    if (behavior.situation.empty()) {
      add_null_sometimes(node, "situation");
      return;
    }
    Node conditions = mapping();
    for (const Condition& condition : behavior.situation) {
      const Variable& variable = catalog_.variables[condition.variable];
      if (condition.values.size() == 1 && random_.percent(75)) {
        conditions.add(variable.name, value_of(variable, condition.values.front()));
        continue;
      }
      Node values = sequence();
      for (const std::size_t value : condition.values) {
        values.add(value_of(variable, value));
      }
      conditions.add(variable.name, std::move(values));
    }
    node.add("situation", std::move(conditions));
  }

  // As `task:` or as `tasks:`; the suitability of the behavior itself stands in for those that the
  // entries leave out, the default for that.
  void add_performed(Node& node, const Behavior& behavior) {
    const Millionths by_default = catalog_.defaults.suitability.value_or(whole_degree);
    const Performance& first = behavior.performs.front();
    if (behavior.performs.size() == 1 && random_.percent(75)) {
      node.add("task", text(catalog_.tasks[first.task].name));
      if (first.suitability != by_default || random_.percent(40)) {
        add_suitability(node, first.suitability);
      } else {
        add_null_sometimes(node, "suitability");
      }
      return;
    }
    Millionths otherwise = by_default;
    if (random_.percent(50)) {
      otherwise = random_.pick(behavior.performs).suitability;
      add_suitability(node, otherwise);
    }
    Node list = sequence();
    for (const Performance& performed : behavior.performs) {
      Node entry = mapping();
      entry.add("task", text(catalog_.tasks[performed.task].name));
      if (performed.suitability != otherwise || random_.percent(40)) {
        entry.add("suitability", percentage(performed.suitability));
      } else {
        add_null_sometimes(entry, "suitability");
      }
      list.add(std::move(entry));
    }
    node.add("tasks", std::move(list));
  }

  Node exclusivity() {
    Node list = sequence();
    for (std::size_t place = 0; place < catalog_.exclusivity.size(); ++place) {
      const std::vector<std::size_t>& exclusive = catalog_.exclusivity[place];
      Node names = sequence();
      for (const std::size_t task : exclusive) {
        names.add(text(catalog_.tasks[task].name));
      }
      Node entry = mapping();
      entry.add("mutually_exclusive", std::move(names));
      if (catalog_.most(place) > 1) {
        entry.add("at_most", plain(std::to_string(catalog_.most(place))));
      }
      list.add(std::move(entry));
    }
    return list;
  }

  const Catalog& catalog_;
  std::size_t chance_of_old_names_;
  std::size_t chance_of_noise_;
};

class ScriptWriter : public Writer {
 public:
  ScriptWriter(const Catalog& catalog, const Script& script, Random& random, bool as_json)
      : Writer(random, as_json), catalog_(catalog), script_(script) {}

  Node write() {
    Node events = sequence();
    for (const Event& event : script_.events) {
      events.add(event_entry(event));
    }
    if (!script_.reactive_delay && script_.situation.empty() && random_.percent(50)) {
      return events;
    }
    Node root = mapping();
    if (script_.reactive_delay) {
      root.add("reactive_delay", seconds(*script_.reactive_delay));
    }
    if (!script_.situation.empty()) {
      root.add("situation", situation(script_.situation));
    }
    root.add("events", std::move(events));
    return root;
  }

 private:
  Node event_entry(const Event& event) {
    Node node = mapping();
    switch (event.verb) {
      case Verb::start:
        node.add("start", text(catalog_.tasks[event.subject].name));
        if (event.parameters) {
          node.add("parameters", any(*event.parameters));
        } else if (random_.percent(5)) {
          node.add("parameters", null());
        }
        break;
      case Verb::stop:
        node.add("stop", text(catalog_.tasks[event.subject].name));
        break;
      case Verb::finish:
        node.add("finish", finished(event));
        if (event.cause != Cause::goal_achieved || random_.percent(50)) {
          node.add("cause", text(to_string(event.cause)));
        }
        break;
      case Verb::situation:
        node.add("situation", situation(event.situation));
        break;
      case Verb::fault:
        node.add("fault", text(catalog_.behaviors[event.subject].name));
        break;
      case Verb::repair:
        node.add("repair", text(catalog_.behaviors[event.subject].name));
        break;
      case Verb::wait:
      case Verb::reconsider:
        break;
    }
    if (event.priority) {
      node.add("priority", plain(std::to_string(*event.priority)));
    }
    if (event.at) {
      node.add("at", seconds(*event.at));
    }
    if (event.wait) {
      node.add("wait", seconds(*event.wait));
    }
    if (random_.percent(15)) {
      random_.shuffle(node.entries);
    }
    return node;
  }

  Node finished(const Event& event) {
    if (event.performed_task == none) {
      return text(catalog_.behaviors[event.subject].name);
    }
    Node node = mapping();
    node.add("task", text(catalog_.tasks[event.performed_task].name));
    return node;
  }

  Node situation(const Situation& situation) {
    Node node = mapping();
    for (const auto& [behavior, own] : situation.own) {
      node.add(catalog_.behaviors[behavior].name, boolean(own));
    }
    for (const auto& [variable, value] : situation.variables) {
      const Variable& changed = catalog_.variables[variable];
      node.add(changed.name, value_of(changed, value));
    }
    random_.shuffle(node.entries);
    return node;
  }

  static Node any(const Parameters& value) {
    if (value.is_object()) {
      Node node = mapping();
      for (const auto& [key, item] : value.items()) {
        node.add(key, any(item));
      }
      return node;
    }
    if (value.is_array()) {
      Node node = sequence();
      for (const Parameters& item : value) {
        node.add(any(item));
      }
      return node;
    }
    return value.is_null() ? null() : text(value.get<std::string>());
  }

  const Catalog& catalog_;
  const Script& script_;
};

}  // namespace

std::string catalog_yaml(const Catalog& catalog, Random& random) {
  const bool as_json = random.percent(5);
  const Node root = CatalogWriter(catalog, random, as_json).write();
  return Printer(random, as_json).print(root);
}

std::string script_yaml(const Catalog& catalog, const Script& script, Random& random) {
  const bool as_json = random.percent(10);
  const Node root = ScriptWriter(catalog, script, random, as_json).write();
  return Printer(random, as_json).print(root);
}

}  // namespace cbc::oracle
