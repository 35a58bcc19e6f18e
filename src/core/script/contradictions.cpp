#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/script/expectation.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using NamedTask = StateClaims::Task;
using NamedBehavior = StateClaims::Behavior;

/// The claims by what they are about.
class ClaimIndex {
 public:
  explicit ClaimIndex(const StateClaims& claims) : claims_(claims) {
    for (const NamedTask& task : claims.stopped) stopped_.try_emplace(task.id, &task);
    for (const StateClaims::Only& only : claims.only_active) {
      only_.emplace_back(only.behaviors.begin(), only.behaviors.end());
    }
    for (const StateClaims::Running& entry : claims.running) {
      if (!entry.behaviors.empty()) chosen_.insert(entry.task.id);
    }
  }

  /// The claim that a task is stopped; null if there is none.
  [[nodiscard]] const NamedTask* stopped(TaskId task) const {
    const auto found = stopped_.find(task);
    return found == stopped_.end() ? nullptr : found->second;
  }
  /// The place of a list of all active behaviors that the behavior is not on; null if there is
  /// none.
  [[nodiscard]] const Range* excluding(BehaviorId behavior) const {
    for (std::size_t place = 0; place < only_.size(); ++place) {
      if (!only_[place].contains(behavior)) return &claims_.only_active[place].range;
    }
    return nullptr;
  }
  [[nodiscard]] bool may_be_active(BehaviorId behavior) const {
    return excluding(behavior) == nullptr;
  }
  /// Whether a task is to run with certain behaviors.
  [[nodiscard]] bool has_behaviors(TaskId task) const { return chosen_.contains(task); }

 private:
  const StateClaims& claims_;
  std::unordered_map<TaskId, const NamedTask*> stopped_;
  std::vector<std::unordered_set<BehaviorId>> only_;
  std::unordered_set<TaskId> chosen_;
};

/// Whether an active behavior may be the one that performs a task.
bool is_performed(const ClaimIndex& index, const CompiledCatalog& catalog, TaskId task) {
  const auto values = catalog.values[task];
  return std::any_of(values.begin(), values.end(),
                     [&index](const Value& value) { return index.may_be_active(value.behavior); });
}

bool performs(const CompiledCatalog& catalog, BehaviorId behavior, TaskId task) {
  const auto values = catalog.values[task];
  return std::any_of(values.begin(), values.end(),
                     [behavior](const Value& value) { return value.behavior == behavior; });
}

/// "behavior 'GPS' does not perform task 'LAND', it performs 'LOCALIZE'"
std::string describe_misplaced(const CompiledCatalog& catalog, BehaviorId behavior, TaskId task) {
  std::vector<std::uint32_t> performed;
  for (const ValueId value : catalog.performs[behavior]) {
    performed.push_back(catalog.tasks[catalog.task_of(value)].catalog_index);
  }
  const std::uint32_t first = *std::min_element(performed.begin(), performed.end());
  std::string tasks = quote(catalog.task_names[first]);
  if (performed.size() > 1) tasks += concat(" and ", performed.size() - 1, " more");
  return concat("behavior ", quote(catalog.name_of_behavior(behavior)), " does not perform task ",
                quote(catalog.name_of_task(task)), ", it performs ", tasks);
}

/// What is examined, and who takes what is found.
class Examination {
 public:
  Examination(const StateClaims& claims, const CompiledCatalog& catalog, const Reporter& reporter,
              const OnContradiction& on_contradiction)
      : claims_(claims),
        catalog_(catalog),
        reporter_(reporter),
        on_contradiction_(on_contradiction),
        index_(claims) {}

 protected:
  const StateClaims& claims_;
  const CompiledCatalog& catalog_;
  const Reporter& reporter_;
  const OnContradiction& on_contradiction_;
  const ClaimIndex index_;
};

/// Gives the active behaviors the tasks that are left for them.
class Placement : private Examination {
 public:
  using Examination::Examination;

  void find() && {
    check_performers();
    check_stopped();
    take_tasks();
    std::vector<const NamedBehavior*> waiting;
    for (const NamedBehavior& behavior : claims_.active) {
      if (!index_.may_be_active(behavior.id)) continue;  // check_others() says so
      if (open_.try_emplace(behavior.id, &behavior).second) waiting.push_back(&behavior);
    }
    std::reverse(waiting.begin(), waiting.end());
    while (!waiting.empty()) {
      const NamedBehavior& behavior = *waiting.back();
      waiting.pop_back();
      if (!open_.contains(behavior.id)) continue;
      const std::optional<TaskId> task = place(behavior);
      if (!task) continue;
      // That may have been the only one that was left for another behavior.
      for (const Value& value : catalog_.values[*task]) {
        const auto other = open_.find(value.behavior);
        if (other != open_.end()) waiting.push_back(other->second);
      }
    }
    if (!claims_.only_active.empty()) check_others();
  }

 private:
  /// Of the behaviors that are listed for a task, one must perform it.
  void check_performers() {
    for (const StateClaims::Running& entry : claims_.running) {
      const auto& listed = entry.behaviors;
      const auto fits = [&](const NamedBehavior& behavior) {
        return performs(catalog_, behavior.id, entry.task.id);
      };
      if (listed.empty() || std::any_of(listed.begin(), listed.end(), fits)) {
        running_.push_back(&entry);
        continue;
      }
      for (const NamedBehavior& behavior : listed) {
        on_contradiction_(behavior.range, describe_misplaced(catalog_, behavior.id, entry.task.id),
                          {});
      }
    }
  }

  void check_stopped() {
    std::unordered_map<TaskId, const NamedTask*> running;
    for (const StateClaims::Running& entry : claims_.running) {
      running.try_emplace(entry.task.id, &entry.task);
    }
    for (const NamedTask& task : claims_.stopped) {
      const auto runs = running.find(task.id);
      if (runs == running.end()) continue;
      on_contradiction_(
          task.range,
          concat("task ", quote(catalog_.name_of_task(task.id)), " is also expected to run"),
          {reporter_.note(runs->second->range, "expected to run here")});
    }
  }

  /// For the behaviors that tasks are to run with. Of several that are listed for a task, those are
  /// left that all lists have.
  void take_tasks() {
    std::unordered_map<TaskId, std::vector<NamedBehavior>> left;
    for (const StateClaims::Running* running : running_) {
      const StateClaims::Running& entry = *running;
      if (entry.behaviors.empty()) continue;
      const auto [found, is_first] = left.try_emplace(entry.task.id, entry.behaviors);
      taken_[entry.task.id].push_back(entry.behaviors);
      if (is_first || found->second.empty()) continue;
      const Range before = found->second.front().range;
      std::unordered_set<BehaviorId> listed;
      for (const NamedBehavior& behavior : entry.behaviors) listed.insert(behavior.id);
      std::erase_if(found->second,
                    [&](const NamedBehavior& behavior) { return !listed.contains(behavior.id); });
      if (!found->second.empty()) continue;
      on_contradiction_(entry.behaviors.front().range,
                        concat("task ", quote(catalog_.name_of_task(entry.task.id)),
                               " is also expected to run with another behavior"),
                        {reporter_.note(before, "expected here")});
    }
  }

  /// If it is settled which task the behavior performs, or that there is none, the behavior is no
  /// longer open. Returns the task.
  std::optional<TaskId> place(const NamedBehavior& behavior) {
    std::vector<TaskId> left;
    std::vector<Note> notes;
    for (const ValueId value : catalog_.performs[behavior.id]) {
      const TaskId task = catalog_.task_of(value);
      const std::string name = quote(catalog_.name_of_task(task));
      if (const NamedBehavior* other = other_behavior(task, behavior.id)) {
        notes.push_back(
            reporter_.note(other->range, name + " is expected to run with another behavior here"));
      } else if (const NamedTask* stop = index_.stopped(task)) {
        notes.push_back(reporter_.note(stop->range, name + " is expected to be stopped here"));
      } else {
        left.push_back(task);
      }
    }
    if (left.size() > 1) return std::nullopt;
    open_.erase(behavior.id);
    if (left.empty()) {
      on_contradiction_(
          behavior.range,
          "no task is left for behavior " + quote(catalog_.name_of_behavior(behavior.id)),
          std::move(notes));
      return std::nullopt;
    }
    taken_[left.front()].push_back({behavior});
    return left.front();
  }

  /// Another behavior that has taken the task; null if there is none.
  [[nodiscard]] const NamedBehavior* other_behavior(TaskId task, BehaviorId behavior) const {
    const auto found = taken_.find(task);
    if (found == taken_.end()) return nullptr;
    const auto is_behavior = [behavior](const NamedBehavior& entry) {
      return entry.id == behavior;
    };
    for (const std::vector<NamedBehavior>& listed : found->second) {
      if (std::none_of(listed.begin(), listed.end(), is_behavior)) return &listed.front();
    }
    return nullptr;
  }

  /// Only the behaviors that are listed are active.
  void check_others() {
    const auto complain = [this](const Range& range, const std::string& why, const Range& only) {
      on_contradiction_(range, why, {reporter_.note(only, "no other behavior is to be active")});
    };
    const auto is_missing = [this](const NamedBehavior& behavior) {
      return concat("behavior ", quote(catalog_.name_of_behavior(behavior.id)),
                    " is not among those that are to be active");
    };
    for (const NamedBehavior& behavior : claims_.active) {
      if (const Range* only = index_.excluding(behavior.id)) {
        complain(behavior.range, is_missing(behavior), *only);
      }
    }
    const Range& only = claims_.only_active.front().range;
    for (const StateClaims::Running* running : running_) {
      const auto& listed = running->behaviors;
      const TaskId task = running->task.id;
      const auto may_be_active = [this](const NamedBehavior& behavior) {
        return index_.may_be_active(behavior.id);
      };
      if (listed.empty()) {
        if (is_performed(index_, catalog_, task)) continue;
        complain(running->task.range,
                 concat("no behavior that performs task ", quote(catalog_.name_of_task(task)),
                        " is among those that are to be active"),
                 only);
      } else if (std::none_of(listed.begin(), listed.end(), may_be_active)) {
        complain(listed.front().range,
                 listed.size() == 1 ? is_missing(listed.front())
                                    : concat("none of the behaviors listed for task ",
                                             quote(catalog_.name_of_task(task)),
                                             " is among those that are to be active"),
                 only);
      }
    }
  }

  std::vector<const StateClaims::Running*> running_;  ///< without those of check_performers()
  /// By task, who may perform it: one of each list does.
  std::unordered_map<TaskId, std::vector<std::vector<NamedBehavior>>> taken_;
  std::unordered_map<BehaviorId, const NamedBehavior*> open_;  ///< active, with several tasks left
};

/// Follows from each claim which tasks run if it holds.
class Consequences : private Examination {
 public:
  using Examination::Examination;

  /// The tasks that the claims themselves say to run.
  void add_claimed() {
    for (const StateClaims::Running& entry : claims_.running) {
      add({entry.task.id, entry.task.range, std::nullopt});
      for (const NamedBehavior& behavior : entry.behaviors) {
        if (performs(catalog_, behavior.id, entry.task.id)) continue;
        complain(behavior.range, describe_misplaced(catalog_, behavior.id, entry.task.id), {});
      }
    }
    for (const NamedBehavior& active : claims_.active) {
      const auto performed = catalog_.performs[active.id];
      if (performed.size() != 1) continue;
      add({catalog_.task_of(performed.front()), active.range, std::nullopt});
    }
  }

  /// All that is required by what runs. To be called after add_claimed().
  void add_required() {
    for (const StateClaims::Running& entry : claims_.running) {
      std::vector<BehaviorId> behaviors;
      for (const NamedBehavior& behavior : entry.behaviors) {
        const bool is_left =
            performs(catalog_, behavior.id, entry.task.id) && index_.may_be_active(behavior.id);
        if (is_left) behaviors.push_back(behavior.id);
      }
      if (!behaviors.empty()) require(behaviors, entry.behaviors.front().range, std::nullopt);
    }
    for (const NamedBehavior& active : claims_.active)
      require({active.id}, active.range, std::nullopt);
    // More are added on the way.
    for (std::size_t place = 0; place < running_.size(); ++place) {
      const Running& entry = running_[place];
      if (index_.has_behaviors(entry.task)) continue;
      std::vector<BehaviorId> behaviors;
      for (const Value& value : catalog_.values[entry.task]) {
        if (index_.may_be_active(value.behavior)) behaviors.push_back(value.behavior);
      }
      if (!behaviors.empty()) require(behaviors, Range(entry.range), place);
    }
  }

 private:
  /// How it follows that a task runs.
  struct Link {
    std::optional<std::size_t> from;  ///< what it follows from, in running_; empty: a claim
    BehaviorId behavior = none;       ///< that requires the task; the first one, if it is one of
    bool is_one_of_several = false;   ///< that have the same requirement
    const CompiledRequirement* requirement = nullptr;
  };
  struct Running {
    TaskId task;
    Range range;               ///< of the claim that it follows from
    std::optional<Link> link;  ///< empty: it is the claim
  };

  [[nodiscard]] std::string describe(const Link& link) const {
    const std::string name = quote(catalog_.name_of_behavior(link.behavior));
    return concat(link.is_one_of_several ? concat("each behavior left for it, such as ", name, ",")
                                         : concat("behavior ", name),
                  " requires task ", quote(catalog_.name_of_task(link.requirement->task)), " (",
                  printable(catalog_.file), ":", catalog_.line_of(*link.requirement), ")");
  }

  /// From the claim on; of many links, the first and the last ones. Empty if it is the claim.
  [[nodiscard]] std::string describe_reason(const Running& running) const {
    constexpr std::size_t links_at_an_end = 3;
    std::vector<const Link*> links;
    const Running* last = &running;
    while (last->link) {
      links.push_back(&*last->link);
      if (!last->link->from) break;
      last = &running_[*last->link->from];
    }
    std::string text;
    for (std::size_t place = links.size(); place-- > 0;) {
      const bool is_end = place < links_at_an_end || place + links_at_an_end >= links.size();
      if (is_end) {
        text += concat(text.empty() ? "" : ", ", describe(*links[place]));
      } else if (place == links_at_an_end) {
        text += ", and so on";
      }
    }
    return text;
  }

  void complain(const Range& range, const std::string& reason, const std::string& why,
                std::vector<Note> notes = {}) {
    on_contradiction_(range, reason + (reason.empty() || why.empty() ? "" : ", and ") + why,
                      std::move(notes));
  }

  /// That a task runs.
  void add(const Running& running) {
    if (!tasks_.insert(running.task).second) return;
    for (const std::uint32_t clique : catalog_.task_cliques[running.task]) {
      const auto [other, is_first] = in_clique_.try_emplace(clique, running_.size());
      if (is_first || !reported_.emplace(running_[other->second].task, running.task).second) {
        continue;
      }
      const Running& earlier = running_[other->second];
      std::string reason = describe_reason(earlier);
      if (!reason.empty() && running.link) reason += ", ";
      complain(running.range, reason + describe_reason(running),
               concat(quote(catalog_.name_of_task(earlier.task)), " excludes ",
                      quote(catalog_.name_of_task(running.task)), " (", printable(catalog_.file),
                      ":", catalog_.clique_lines[clique], ")"));
    }
    running_.push_back(running);
    if (!running.link) return;
    if (const NamedTask* stop = index_.stopped(running.task)) {
      complain(running.range, describe_reason(running), {},
               {reporter_.note(stop->range, "expected to be stopped here")});
    } else if (catalog_.values[running.task].empty()) {
      complain(running.range, describe_reason(running), "no behavior performs it");
    } else if (!is_performed(index_, catalog_, running.task)) {
      complain(
          running.range, describe_reason(running), "no behavior that performs it is to be active",
          {reporter_.note(claims_.only_active.front().range, "no other behavior is to be active")});
    }
  }

  /// What is required whichever of these behaviors is active. `from`: why one of them is, in
  /// running_; empty: a claim says so.
  void require(const std::vector<BehaviorId>& behaviors, const Range& range,
               std::optional<std::size_t> from) {
    for (const CompiledRequirement& requirement : catalog_.requirements[behaviors.front()]) {
      const bool is_common =
          std::all_of(behaviors.begin(), behaviors.end(), [&](BehaviorId behavior) {
            const auto others = catalog_.requirements[behavior];
            return std::any_of(others.begin(), others.end(), [&](const CompiledRequirement& other) {
              return other.task == requirement.task;
            });
          });
      if (!is_common) continue;
      add({requirement.task, range,
           Link{from, behaviors.front(), behaviors.size() > 1, &requirement}});
    }
  }

  std::vector<Running> running_;
  std::set<TaskId> tasks_;                          ///< of running_
  std::map<std::uint32_t, std::size_t> in_clique_;  ///< places in running_
  std::set<std::pair<TaskId, TaskId>> reported_;
};

}  // namespace

void find_contradictions(const StateClaims& claims, const CompiledCatalog& catalog,
                         const Reporter& reporter, const OnContradiction& on_contradiction) {
  Placement(claims, catalog, reporter, on_contradiction).find();
}

void find_excluded(const StateClaims& claims, const CompiledCatalog& catalog,
                   const Reporter& reporter, const OnContradiction& on_contradiction) {
  Consequences(claims, catalog, reporter, on_contradiction).add_claimed();
}

void find_ruled_out(const StateClaims& claims, const CompiledCatalog& catalog,
                    const Reporter& reporter, const OnContradiction& on_contradiction) {
  Consequences consequences(claims, catalog, reporter, on_contradiction);
  consequences.add_claimed();
  consequences.add_required();
}

}  // namespace cbc
