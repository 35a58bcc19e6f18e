#include "core/script/expectation.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "core/diagnostic/rules.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::Kind;
using yaml::Node;

/// Whether the behavior that a task is to run with performs it.
bool performs(const CompiledCatalog& catalog, const StateClaims::Running& claim) {
  if (!claim.behavior) return true;
  const auto values = catalog.values[claim.task.id];
  return std::any_of(values.begin(), values.end(),
                     [&claim](const Value& value) { return value.behavior == claim.behavior->id; });
}

void check_performs(const RunningEntry& entry, const CompiledCatalog& catalog,
                    const Standing& standing, Reporter& reporter) {
  if (performs(catalog, claim_of(entry, catalog))) return;
  std::vector<std::uint32_t> performed;
  for (const ValueId value : catalog.performs[catalog.behavior_ids[*entry.behavior]]) {
    performed.push_back(catalog.tasks[catalog.task_of(value)].catalog_index);
  }
  const std::uint32_t first = *std::min_element(performed.begin(), performed.end());
  std::string performed_tasks = quote(catalog.task_names[first]);
  if (performed.size() > 1) {
    performed_tasks += " and " + std::to_string(performed.size() - 1) + " more";
  }
  reporter.report_as(standing, rule::impossible_expectation, entry.behavior_range,
                     "this can never hold: behavior " +
                         quote(catalog.behavior_names[*entry.behavior]) +
                         " does not perform task " + quote(catalog.task_names[entry.task]) +
                         ", it performs " + performed_tasks);
}

class ExpectationReader {
 public:
  ExpectationReader(NameIndex& names, Reporter& reporter) : names_(names), reporter_(reporter) {}

  Expectation read(const Node& node) && {
    if (yaml::read_mapping(node, "expect", "a mapping", reporter_) == nullptr) return {};
    const std::size_t errors = reporter_.errors();
    yaml::Fields fields(node, shape::expectation, reporter_);
    if (const Node* outcome = fields.find("outcome")) {
      out_.outcome = read_word<Outcome>(*outcome, "outcome", reporter_);
    }
    std::vector<RunningEntry> running;
    if (const Node* entries = fields.find("running")) {
      running = read_running(*entries, names_, of_impossible, reporter_);
    }
    for (const RunningEntry& entry : running) out_.running.push_back({entry.task, entry.behavior});
    for (const RunningEntry& entry : running) {
      const StateClaims::Running claim = claim_of(entry, names_.catalog());
      if (performs(names_.catalog(), claim)) claims_.running.push_back(claim);
    }
    if (const Node* stopped = fields.find("stopped")) read_stopped(*stopped, running);
    if (const Node* active = fields.find("active")) {
      read_active(*active);
      claims_.only_active = fields.range_of("active");
    }
    fields.report_unknown(yaml::UnknownKeys::refused);
    if (reporter_.errors() == errors) check_claims();
    return std::move(out_);
  }

 private:
  /// The script has a meaning even so.
  static constexpr Standing of_impossible{Severity::warning};

  void read_stopped(const Node& node, const std::vector<RunningEntry>& running) {
    if (yaml::read_list(node, "stopped", "a list of tasks", reporter_) == nullptr) return;
    for (const Node* item : node.items) {
      const auto task = names_.find_task(*item, "stopped", reporter_, &node);
      if (!task) continue;
      out_.stopped.push_back(*task);
      claims_.stopped.push_back({names_.catalog().task_ids[*task], item->range});
      check_stopped(*task, item->range, running, names_.catalog(), of_impossible, reporter_);
    }
  }

  void read_active(const Node& node) {
    if (yaml::read_list(node, "active", "a list of behaviors", reporter_) == nullptr) return;
    auto& behaviors = out_.active.emplace();
    for (const Node* item : node.items) {
      const auto behavior = names_.find_behavior(*item, "active", reporter_, &node);
      if (!behavior) continue;
      behaviors.push_back(*behavior);
      claims_.active.push_back({names_.catalog().behavior_ids[*behavior], item->range});
    }
  }

  void check_claims() {
    bool is_possible = true;
    const OnContradiction report = [&](const Range& range, const std::string& why,
                                       std::vector<Note> notes) {
      is_possible = false;
      reporter_.report_as(of_impossible, rule::impossible_expectation, range,
                          "this can never hold: " + why, std::move(notes));
    };
    find_contradictions(claims_, names_.catalog(), reporter_, report);
    if (is_possible) find_ruled_out(claims_, names_.catalog(), reporter_, report);
  }

  NameIndex& names_;
  Reporter& reporter_;
  Expectation out_;
  StateClaims claims_;
};

}  // namespace

Expectation read_expectation(const Node& node, NameIndex& names, Reporter& reporter) {
  return ExpectationReader(names, reporter).read(node);
}

StateClaims::Running claim_of(const RunningEntry& entry, const CompiledCatalog& catalog) {
  StateClaims::Running claim{{catalog.task_ids[entry.task], entry.task_range}, std::nullopt};
  if (entry.behavior) {
    claim.behavior = {catalog.behavior_ids[*entry.behavior], entry.behavior_range};
  }
  return claim;
}

std::vector<RunningEntry> read_running(const Node& node, NameIndex& names,
                                       const Standing& of_misfit, Reporter& reporter) {
  constexpr std::string_view expected = "a mapping of tasks to behaviors or 'any'";
  std::vector<RunningEntry> running;
  if (yaml::read_mapping(node, "running", expected, reporter) == nullptr) return running;
  yaml::report_duplicate_keys(node, reporter);
  for (const auto& [key, value] : node.entries) {
    const auto task = names.find_task(*key, "running", reporter, &node);
    RunningEntry entry{task.value_or(0), std::nullopt, key->range, value->range};
    if (value->kind != Kind::scalar) {
      yaml::report_wrong_type(*value, key->text, "a behavior or 'any'", reporter);
    } else if (value->text != "any") {
      entry.behavior = names.find_behavior(*value, key->text, reporter);
    }
    if (!task) continue;
    if (entry.behavior) check_performs(entry, names.catalog(), of_misfit, reporter);
    running.push_back(entry);
  }
  return running;
}

void check_stopped(std::uint32_t task, const Range& range, const std::vector<RunningEntry>& running,
                   const CompiledCatalog& catalog, const Standing& standing, Reporter& reporter) {
  const auto runs = std::find_if(running.begin(), running.end(),
                                 [task](const RunningEntry& entry) { return entry.task == task; });
  if (runs == running.end()) return;
  reporter.report_as(
      standing, rule::impossible_expectation, range,
      "this can never hold: task " + quote(catalog.task_names[task]) + " is also expected to run",
      {reporter.note(runs->task_range, "expected to run here")});
}

}  // namespace cbc
