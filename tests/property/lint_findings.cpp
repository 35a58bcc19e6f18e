#include "lint_findings.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "demand.h"

namespace cbc::oracle {
namespace {

using yaml::Node;

std::string in_quotes(const std::string& name) { return "'" + name + "'"; }

// What stands between two parts of a text.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t place = text.find(begin);
  demand(place != std::string::npos && text.ends_with(end), "not the message of this rule");
  const std::size_t first = place + begin.size();
  return text.substr(first, text.size() - end.size() - first);
}

// Where the parts of a catalog stand.
class Places {
 public:
  Places(const Catalog& catalog, const Node& root) {
    task_names.resize(catalog.tasks.size());
    task_minimums.resize(catalog.tasks.size());
    read_tasks(catalog, root);
    read_behaviors(catalog, root);
    if (const Node* lists = root.find("exclusivity_constraints")) {
      for (const Node* list : lists->items) {
        exclusivity.push_back(list->entries.front().first->range);
      }
    }
  }

  struct Entry {
    Range task;
    Range minimum;
  };

  std::vector<Range> task_names;
  std::vector<Range> task_minimums;
  std::vector<Range> behavior_names;
  std::vector<std::vector<Entry>> requirements;  // of each behavior
  std::vector<Range> exclusivity;

 private:
  void read_tasks(const Catalog& catalog, const Node& root) {
    const Node* list = root.find("tasks");
    std::size_t next = 0;
    for (std::size_t task = 0; task < catalog.tasks.size(); ++task) {
      if (!catalog.tasks[task].listed) continue;
      const Node& node = *list->items.at(next++);
      task_names[task] = node.find("task")->range;
      if (const Node* minimum = node.find("minimum_performance")) {
        task_minimums[task] = minimum->range;
      }
    }
  }

  void read_behaviors(const Catalog& catalog, const Node& root) {
    std::vector<bool> named(catalog.tasks.size());
    const auto read_performed = [&](const Node& node) {
      const Node& name = *node.find("task");
      for (std::size_t task = 0; task < catalog.tasks.size(); ++task) {
        if (catalog.tasks[task].listed || catalog.tasks[task].name != name.text) continue;
        if (!named[task]) task_names[task] = name.range;
        named[task] = true;
      }
    };
    for (const Node* node : root.find("behaviors")->items) {
      behavior_names.push_back(node->find("behavior")->range);
      if (const Node* tasks = node->find("tasks")) {
        for (const Node* item : tasks->items) read_performed(*item);
      } else {
        read_performed(*node);
      }
      requirements.emplace_back();
      const Node* list = node->find("requires");
      if (list == nullptr) continue;
      for (const Node* item : list->items) {
        const Node* minimum = item->find("minimum_performance");
        requirements.back().push_back(
            {item->find("task")->range, minimum == nullptr ? Range{} : minimum->range});
      }
    }
  }
};

class FindingReader {
 public:
  FindingReader(const LintOracle& oracle, const Node& root)
      : oracle_(oracle), catalog_(oracle.facts().catalog), places_(catalog_, root) {}

  void read(const Diagnostic& finding) {
    if (finding.rule == "exclusive-requirement") {
      const RequirementEntry entry = entry_at(finding.range);
      demand(std::find(findings_.exclusive.begin(), findings_.exclusive.end(), entry) ==
                 findings_.exclusive.end(),
             "given twice");
      findings_.exclusive.push_back(entry);
    } else if (finding.rule == "conflicting-requirements") {
      read_conflict(finding);
    } else if (finding.rule == "unreachable-performance") {
      read_unreachable(finding);
    } else if (finding.rule == "dead-task") {
      const std::size_t dead = find(places_.task_names, finding.range);
      add(findings_.dead_tasks, dead, read_reason(finding, oracle_.facts().group_of[dead]));
    } else if (finding.rule == "dead-behavior") {
      const std::size_t dead = find(places_.behavior_names, finding.range);
      add(findings_.dead_behaviors, dead, read_reason(finding, oracle_.group_of_behavior(dead)));
    } else if (finding.rule == "redundant-requirement") {
      read_redundant(finding);
    } else if (finding.rule == "requires-on-request") {
      read_on_request(finding);
    } else {
      demand(finding.rule != "undecided", "undecided");
      demand(finding.severity != Severity::error, "an error that should not be");
    }
  }

  Findings take() { return std::move(findings_); }

 private:
  template <typename Key, typename Value>
  static void add(std::map<Key, Value>& findings, const Key& key, Value value) {
    demand(findings.emplace(key, std::move(value)).second, "given twice");
  }

  static std::size_t find(const std::vector<Range>& ranges, const Range& range) {
    const auto found = std::find(ranges.begin(), ranges.end(), range);
    demand(found != ranges.end(), "nothing that the rule is about stands there");
    return static_cast<std::size_t>(found - ranges.begin());
  }

  // By the place of the name of its task, or of its minimum.
  std::optional<RequirementEntry> find_entry(const Range& range, Range Places::Entry::*part) const {
    for (std::size_t behavior = 0; behavior < places_.requirements.size(); ++behavior) {
      for (std::size_t i = 0; i < places_.requirements[behavior].size(); ++i) {
        if (places_.requirements[behavior][i].*part == range) return RequirementEntry{behavior, i};
      }
    }
    return std::nullopt;
  }

  RequirementEntry entry_at(const Range& range) const {
    const auto entry = find_entry(range, &Places::Entry::task);
    demand(entry.has_value(), "no requirement stands there");
    return *entry;
  }

  const Requirement& requirement(const RequirementEntry& entry) const {
    return catalog_.behaviors[entry.behavior].requirements[entry.place];
  }

  void read_conflict(const Diagnostic& finding) {
    const RequirementEntry entry = entry_at(finding.range);
    demand(finding.notes.size() == 2, "not two notes");
    const RequirementEntry other = entry_at(finding.notes[0].range);
    demand(other.behavior == entry.behavior, "not of the same behavior");
    demand_list(finding.notes[1].range, requirement(entry).task, requirement(other).task);
    add(findings_.conflicting, entry, other);
  }

  void read_unreachable(const Diagnostic& finding) {
    const std::string best = between(finding.message, "the best that can be reached is ", " %");
    if (const auto entry = find_entry(finding.range, &Places::Entry::minimum)) {
      add(findings_.unreachable, *entry, best);
    } else {
      add(findings_.unreachable_minimums, find(places_.task_minimums, finding.range), best);
    }
  }

  void read_redundant(const Diagnostic& finding) {
    const RequirementEntry entry = entry_at(finding.range);
    if (finding.notes.size() == 1 &&
        finding.notes.front().message == "it is required here already") {
      const RequirementEntry other = entry_at(finding.notes.front().range);
      demand(other.behavior == entry.behavior && other != entry &&
                 requirement(other).task == requirement(entry).task &&
                 requirement(other).minimum >= requirement(entry).minimum,
             "the note does not say where the same is required");
      demand(std::find(findings_.repeated.begin(), findings_.repeated.end(), entry) ==
                 findings_.repeated.end(),
             "given twice");
      findings_.repeated.push_back(entry);
      return;
    }
    add(findings_.redundant, entry,
        read_reason(finding, oracle_.group_of_behavior(entry.behavior)));
  }

  void read_on_request(const Diagnostic& finding) {
    const RequirementEntry entry = entry_at(finding.range);
    std::string rest = between(finding.message, "starts only on request: request ", " first");
    std::vector<std::size_t> names;
    while (true) {
      const std::size_t end = rest.find(", then ");
      names.push_back(task_named(rest.substr(0, end)));
      if (end == std::string::npos) break;
      rest = rest.substr(end + std::string(", then ").size());
    }
    demand(finding.notes.size() == 1 &&
               finding.notes.front().range == places_.task_names[requirement(entry).task],
           "the note does not say where the task is defined");
    add(findings_.on_request, entry, names);
  }

  std::size_t task_named(const std::string& name) const {
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      if (in_quotes(catalog_.tasks[task].name) == name) return task;
    }
    throw std::runtime_error("no task: " + name);
  }

  void demand_list(const Range& range, std::size_t a, std::size_t b) const {
    const std::vector<std::size_t>& list = catalog_.exclusivity[find(places_.exclusivity, range)];
    demand(std::find(list.begin(), list.end(), a) != list.end() &&
               std::find(list.begin(), list.end(), b) != list.end(),
           "a list without both tasks");
  }

  ConstraintSet read_reason(const Diagnostic& finding, std::size_t group) const {
    demand(!finding.notes.empty(), "no reason");
    ConstraintSet set = 0;
    for (const Note& note : finding.notes) {
      const Constraint constraint = read_constraint(note);
      const ConstraintSet one = oracle_.those(
          group, [&](const Constraint& candidate) { return candidate == constraint; });
      demand(one != 0, "no constraint of the group: " + note.message);
      demand((set & one) == 0, "a constraint twice: " + note.message);
      set |= one;
    }
    return set;
  }

  Constraint read_constraint(const Note& note) const {
    if (const auto entry = find_entry(note.range, &Places::Entry::task)) {
      return {Constraint::Kind::requires_task, requirement(*entry).task, none, entry->behavior, 0};
    }
    if (const auto entry = find_entry(note.range, &Places::Entry::minimum)) {
      const Requirement& required = requirement(*entry);
      return {Constraint::Kind::performance, required.task, none, entry->behavior,
              required.minimum};
    }
    const std::size_t excludes = note.message.find(" excludes ");
    if (excludes != std::string::npos) {
      std::size_t a = task_named(note.message.substr(0, excludes));
      std::size_t b = task_named(note.message.substr(excludes + std::string(" excludes ").size()));
      demand_list(note.range, a, b);
      if (a > b) std::swap(a, b);
      return {Constraint::Kind::exclusive, a, b, none, 0};
    }
    const std::size_t task = find(places_.task_minimums, note.range);
    return {Constraint::Kind::performance, task, none, none, catalog_.tasks[task].minimum};
  }

  const LintOracle& oracle_;
  const Catalog& catalog_;
  const Places places_;
  Findings findings_;
};

std::string text_of(const Diagnostic& finding) {
  std::string text = std::to_string(finding.range.begin.line) + ":" +
                     std::to_string(finding.range.begin.column) + " " + std::string(finding.rule) +
                     ": " + finding.message + "\n";
  for (const Note& note : finding.notes) {
    text += "  " + std::to_string(note.range.begin.line) + ":" +
            std::to_string(note.range.begin.column) + " " + note.message + "\n";
  }
  return text;
}

}  // namespace

Findings lint_findings(const LintOracle& oracle, const std::string& yaml) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(yaml, "catalog.yaml", diagnostics);
  demand(document != nullptr, "not YAML");
  const CheckedCatalog result = lint_catalog(*document, {}, diagnostics);
  demand(result.compiled != nullptr, "not understood");
  FindingReader reader(oracle, document->root());
  for (const Diagnostic& finding : diagnostics.all()) {
    try {
      reader.read(finding);
    } catch (const std::exception& error) {
      throw std::runtime_error(std::string(error.what()) + "\n" + text_of(finding));
    }
  }
  return reader.take();
}

std::string percent_text(Millionths degree) {
  std::string digits = std::to_string(degree);
  if (digits.size() < 5) digits.insert(0, 5 - digits.size(), '0');
  std::string fraction = digits.substr(digits.size() - 4);
  while (!fraction.empty() && fraction.back() == '0') fraction.pop_back();
  return digits.substr(0, digits.size() - 4) + (fraction.empty() ? "" : "." + fraction);
}

}  // namespace cbc::oracle
