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
  explicit ClaimIndex(const StateClaims& claims)
      : says_all_active_(claims.only_active.has_value()) {
    for (const NamedTask& task : claims.stopped) stopped_.try_emplace(task.id, &task);
    for (const NamedBehavior& behavior : claims.active) active_.insert(behavior.id);
    for (const StateClaims::Running& entry : claims.running) {
      if (entry.behavior) chosen_.insert(entry.task.id);
    }
  }

  /// The claim that a task is stopped; null if there is none.
  [[nodiscard]] const NamedTask* stopped(TaskId task) const {
    const auto found = stopped_.find(task);
    return found == stopped_.end() ? nullptr : found->second;
  }
  [[nodiscard]] bool is_active(BehaviorId behavior) const { return active_.contains(behavior); }
  [[nodiscard]] bool may_be_active(BehaviorId behavior) const {
    return !says_all_active_ || is_active(behavior);
  }
  /// Whether a task is to run with a certain behavior.
  [[nodiscard]] bool has_behavior(TaskId task) const { return chosen_.contains(task); }

 private:
  bool says_all_active_;
  std::unordered_map<TaskId, const NamedTask*> stopped_;
  std::unordered_set<BehaviorId> active_;
  std::unordered_set<TaskId> chosen_;
};

/// Whether an active behavior may be the one that performs a task.
bool is_performed(const ClaimIndex& index, const CompiledCatalog& catalog, TaskId task) {
  const auto values = catalog.values[task];
  return std::any_of(values.begin(), values.end(),
                     [&index](const Value& value) { return index.may_be_active(value.behavior); });
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
    for (const StateClaims::Running& entry : claims_.running) {
      if (entry.behavior) taken_[entry.task.id].push_back(*entry.behavior);
    }
    std::vector<const NamedBehavior*> waiting;
    for (const NamedBehavior& behavior : claims_.active) {
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
    if (claims_.only_active) check_others();
  }

 private:
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
    taken_[left.front()].push_back(behavior);
    return left.front();
  }

  /// Another behavior that has taken the task; null if there is none.
  [[nodiscard]] const NamedBehavior* other_behavior(TaskId task, BehaviorId behavior) const {
    const auto found = taken_.find(task);
    if (found == taken_.end()) return nullptr;
    const auto other =
        std::find_if(found->second.begin(), found->second.end(),
                     [behavior](const NamedBehavior& entry) { return entry.id != behavior; });
    return other == found->second.end() ? nullptr : &*other;
  }

  /// Only the behaviors that are listed are active.
  void check_others() {
    const auto note = [this] {
      return std::vector{reporter_.note(*claims_.only_active, "no other behavior is to be active")};
    };
    for (const StateClaims::Running& entry : claims_.running) {
      if (entry.behavior) {
        if (index_.is_active(entry.behavior->id)) continue;
        on_contradiction_(entry.behavior->range,
                          "behavior " + quote(catalog_.name_of_behavior(entry.behavior->id)) +
                              " is not among those that are to be active",
                          note());
      } else if (!is_performed(index_, catalog_, entry.task.id)) {
        on_contradiction_(entry.task.range,
                          "no behavior that performs task " +
                              quote(catalog_.name_of_task(entry.task.id)) +
                              " is among those that are to be active",
                          note());
      }
    }
  }

  std::unordered_map<TaskId, std::vector<NamedBehavior>> taken_;
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
      if (entry.behavior) require({entry.behavior->id}, entry.behavior->range, std::nullopt);
    }
    for (const NamedBehavior& active : claims_.active)
      require({active.id}, active.range, std::nullopt);
    // More are added on the way.
    for (std::size_t place = 0; place < running_.size(); ++place) {
      const Running& entry = running_[place];
      if (index_.has_behavior(entry.task)) continue;
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
    } else if (!is_performed(index_, catalog_, running.task)) {
      complain(running.range, describe_reason(running),
               "no behavior that performs it is to be active",
               {reporter_.note(*claims_.only_active, "no other behavior is to be active")});
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
