#include "script/expectation_reader.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>

#include "cbc/event.h"
#include "cbc/rules.h"
#include "script/shapes.h"
#include "text/quote.h"
#include "yaml/duplicates.h"
#include "yaml/fields.h"
#include "yaml/values.h"

namespace cbc {
namespace {

using yaml::Kind;
using yaml::Node;

class ExpectationReader {
 public:
  ExpectationReader(NameIndex& names, Reporter& reporter) : names_(names), reporter_(reporter) {}

  Expectation read(const Node& node) && {
    if (yaml::read_mapping(node, "expect", "a mapping", reporter_) == nullptr) return {};
    yaml::Fields fields(node, shape::expectation, reporter_);
    if (const Node* outcome = fields.find("outcome")) read_outcome(*outcome);
    if (const Node* running = fields.find("running")) read_running(*running);
    if (const Node* stopped = fields.find("stopped")) read_stopped(*stopped);
    if (const Node* active = fields.find("active")) read_active(*active);
    fields.report_unknown(Severity::error);
    return std::move(out_);
  }

 private:
  void read_outcome(const Node& node) {
    const auto choice = yaml::read_choice(
        node, "outcome",
        {name_of(Outcome::accepted), name_of(Outcome::rejected), name_of(Outcome::unchanged)},
        reporter_);
    if (choice) out_.outcome = static_cast<Outcome>(*choice);
  }

  void read_running(const Node& node) {
    if (yaml::read_mapping(node, "running", "a mapping of tasks to behaviors or 'any'",
                           reporter_) == nullptr) {
      return;
    }
    yaml::report_duplicate_keys(node, reporter_);
    for (const auto& [key, value] : node.entries) {
      Expectation::Running entry;
      const auto task = names_.find_task(*key, "running", reporter_);
      if (value->kind != Kind::scalar) {
        yaml::report_wrong_type(*value, key->text, "a behavior or 'any'", reporter_);
      } else if (value->text != "any") {
        entry.behavior = names_.find_behavior(*value, key->text, reporter_);
      }
      if (task) running_at_.try_emplace(*task, key->range);
      if (task && entry.behavior) check_performs(*entry.behavior, *task, value->range);
      entry.task = task.value_or(0);
      out_.running.push_back(entry);
    }
  }

  void check_performs(std::uint32_t behavior, std::uint32_t task, const Range& range) {
    const CompiledCatalog& catalog = names_.catalog();
    std::vector<std::uint32_t> performed;
    for (const ValueId value : catalog.performs[catalog.behavior_ids[behavior]]) {
      performed.push_back(catalog.tasks[catalog.task_of(value)].catalog_index);
    }
    if (std::find(performed.begin(), performed.end(), task) != performed.end()) return;
    const std::uint32_t first = *std::min_element(performed.begin(), performed.end());
    std::string performs = quote(catalog.task_names[first]);
    if (performed.size() > 1) performs += " and " + std::to_string(performed.size() - 1) + " more";
    reporter_.report(rule::impossible_expectation, range,
                     "this can never hold: behavior " + quote(catalog.behavior_names[behavior]) +
                         " does not perform task " + quote(catalog.task_names[task]) +
                         ", it performs " + performs);
  }

  void read_stopped(const Node& node) {
    if (yaml::read_list(node, "stopped", "a list of tasks", reporter_) == nullptr) return;
    for (const Node* item : node.items) {
      const auto task = names_.find_task(*item, "stopped", reporter_);
      out_.stopped.push_back(task.value_or(0));
      if (!task) continue;
      const auto running = running_at_.find(*task);
      if (running == running_at_.end()) continue;
      reporter_.report(
          rule::impossible_expectation, item->range,
          "this can never hold: task " + quote(item->text) + " is expected to run, too",
          {reporter_.note(running->second, "expected to run here")});
    }
  }

  void read_active(const Node& node) {
    if (yaml::read_list(node, "active", "a list of behaviors", reporter_) == nullptr) return;
    auto& behaviors = out_.active.emplace();
    for (const Node* item : node.items) {
      behaviors.push_back(names_.find_behavior(*item, "active", reporter_).value_or(0));
    }
  }

  NameIndex& names_;
  Reporter& reporter_;
  Expectation out_;
  std::unordered_map<std::uint32_t, Range> running_at_;  ///< by task
};

}  // namespace

Expectation read_expectation(const Node& node, NameIndex& names, Reporter& reporter) {
  return ExpectationReader(names, reporter).read(node);
}

}  // namespace cbc
