#include "script/contradictions.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "base/text.h"

namespace cbc {
namespace {

using Named = StateClaims::Named;

bool names(const std::vector<Named>& list, std::uint32_t id) {
  return std::any_of(list.begin(), list.end(), [id](const Named& entry) { return entry.id == id; });
}

const Named* find(const std::vector<Named>& list, std::uint32_t id) {
  const auto found =
      std::find_if(list.begin(), list.end(), [id](const Named& entry) { return entry.id == id; });
  return found == list.end() ? nullptr : &*found;
}

/// Whether an active behavior may be the one that performs a task.
bool is_performed(const StateClaims& claims, const CompiledCatalog& catalog, TaskId task) {
  const auto values = catalog.values[task];
  return std::any_of(values.begin(), values.end(), [&claims](const Value& value) {
    return !claims.only_active || names(claims.active, value.behavior);
  });
}

/// Gives the active behaviors the tasks that are left for them.
class Placement {
 public:
  Placement(const StateClaims& claims, const CompiledCatalog& catalog, const Reporter& reporter,
            const OnContradiction& on_contradiction)
      : claims_(claims),
        catalog_(catalog),
        reporter_(reporter),
        on_contradiction_(on_contradiction) {}

  void find() && {
    for (const StateClaims::Running& entry : claims_.running) {
      if (entry.behavior) taken_.push_back({entry.task.id, *entry.behavior});
    }
    // A behavior that has only one task left may take the only one that was left for another.
    std::vector<Named> open = claims_.active;
    for (std::size_t before = open.size() + 1; open.size() < before;) {
      before = open.size();
      std::erase_if(open, [this](const Named& behavior) { return place(behavior); });
    }
    if (claims_.only_active) check_others();
  }

 private:
  struct Taken {
    TaskId task;
    Named behavior;
  };

  /// Returns whether it is settled which task the behavior performs, or that there is none.
  bool place(const Named& behavior) {
    std::vector<TaskId> left;
    std::vector<Note> notes;
    for (const ValueId value : catalog_.performs[behavior.id]) {
      const TaskId task = catalog_.task_of(value);
      const std::string name = quote(catalog_.name_of_task(task));
      const auto other = std::find_if(taken_.begin(), taken_.end(), [&](const Taken& entry) {
        return entry.task == task && entry.behavior.id != behavior.id;
      });
      if (other != taken_.end()) {
        notes.push_back(reporter_.note(other->behavior.range,
                                       name + " is expected to run with another behavior here"));
      } else if (const Named* stop = cbc::find(claims_.stopped, task)) {
        notes.push_back(reporter_.note(stop->range, name + " is expected to be stopped here"));
      } else {
        left.push_back(task);
      }
    }
    if (left.empty()) {
      on_contradiction_(
          behavior.range,
          "no task is left for behavior " + quote(catalog_.name_of_behavior(behavior.id)),
          std::move(notes));
    } else if (left.size() == 1) {
      taken_.push_back({left.front(), behavior});
    }
    return left.size() <= 1;
  }

  /// Only the behaviors that are listed are active.
  void check_others() {
    const auto note = [this] {
      return std::vector{reporter_.note(*claims_.only_active, "no other behavior is to be active")};
    };
    for (const StateClaims::Running& entry : claims_.running) {
      if (entry.behavior) {
        if (names(claims_.active, entry.behavior->id)) continue;
        on_contradiction_(entry.behavior->range,
                          "behavior " + quote(catalog_.name_of_behavior(entry.behavior->id)) +
                              " is not among those that are to be active",
                          note());
      } else if (!is_performed(claims_, catalog_, entry.task.id)) {
        on_contradiction_(entry.task.range,
                          "no behavior that performs task " +
                              quote(catalog_.name_of_task(entry.task.id)) +
                              " is among those that are to be active",
                          note());
      }
    }
  }

  const StateClaims& claims_;
  const CompiledCatalog& catalog_;
  const Reporter& reporter_;
  const OnContradiction& on_contradiction_;
  std::vector<Taken> taken_;
};

/// Follows from each claim which tasks run if it holds.
class Consequences {
 public:
  Consequences(const StateClaims& claims, const CompiledCatalog& catalog, const Reporter& reporter,
               const OnContradiction& on_contradiction)
      : claims_(claims),
        catalog_(catalog),
        reporter_(reporter),
        on_contradiction_(on_contradiction) {}

  /// The tasks that the claims themselves say to run.
  void add_claimed() {
    for (const StateClaims::Running& entry : claims_.running)
      add({entry.task.id, entry.task.range});
    for (const Named& active : claims_.active) {
      const auto performed = catalog_.performs[active.id];
      if (performed.size() == 1) add({catalog_.task_of(performed.front()), active.range});
    }
  }

  /// All that is required by what runs. To be called after add_claimed().
  void add_required() {
    for (const StateClaims::Running& entry : claims_.running) {
      if (entry.behavior) require({entry.behavior->id}, entry.behavior->range, {});
    }
    for (const Named& active : claims_.active) require({active.id}, active.range, {});
    // More are added on the way.
    for (std::size_t place = 0; place < running_.size(); ++place) {
      const Running entry = running_[place];
      if (has_behavior(entry.task)) continue;
      std::vector<BehaviorId> behaviors;
      for (const Value& value : catalog_.values[entry.task]) {
        if (!claims_.only_active || names(claims_.active, value.behavior)) {
          behaviors.push_back(value.behavior);
        }
      }
      if (!behaviors.empty()) require(behaviors, entry.range, entry.reason);
    }
  }

 private:
  struct Running {
    TaskId task;
    Range range;              ///< of the claim that it follows from
    std::string reason = {};  ///< how it follows; empty: it is the claim
  };

  [[nodiscard]] bool has_behavior(TaskId task) const {
    return std::any_of(claims_.running.begin(), claims_.running.end(),
                       [task](const StateClaims::Running& entry) {
                         return entry.task.id == task && entry.behavior.has_value();
                       });
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
      std::string reason = earlier.reason;
      if (!reason.empty() && !running.reason.empty()) reason += ", ";
      complain(running.range, reason + running.reason,
               concat(quote(catalog_.name_of_task(earlier.task)), " excludes ",
                      quote(catalog_.name_of_task(running.task)), " (", printable(catalog_.file),
                      ":", catalog_.clique_lines[clique], ")"));
    }
    running_.push_back(running);
    if (running.reason.empty()) return;
    if (const Named* stop = cbc::find(claims_.stopped, running.task)) {
      complain(running.range, running.reason, {},
               {reporter_.note(stop->range, "expected to be stopped here")});
    } else if (!is_performed(claims_, catalog_, running.task)) {
      complain(running.range, running.reason, "no behavior that performs it is to be active",
               {reporter_.note(*claims_.only_active, "no other behavior is to be active")});
    }
  }

  /// What is required whichever of these behaviors is active. `reason`: why one of them is.
  void require(const std::vector<BehaviorId>& behaviors, const Range& range,
               const std::string& reason) {
    for (const CompiledRequirement& requirement : catalog_.requirements[behaviors.front()]) {
      const bool is_common =
          std::all_of(behaviors.begin(), behaviors.end(), [&](BehaviorId behavior) {
            const auto others = catalog_.requirements[behavior];
            return std::any_of(others.begin(), others.end(), [&](const CompiledRequirement& other) {
              return other.task == requirement.task;
            });
          });
      if (!is_common) continue;
      const std::string first = quote(catalog_.name_of_behavior(behaviors.front()));
      std::string why = behaviors.size() == 1
                            ? concat("behavior ", first)
                            : concat("each behavior left for it, such as ", first, ",");
      why += concat(" requires task ", quote(catalog_.name_of_task(requirement.task)), " (",
                    printable(catalog_.file), ":", catalog_.line_of(requirement), ")");
      add({requirement.task, range, reason.empty() ? why : concat(reason, ", ", why)});
    }
  }

  const StateClaims& claims_;
  const CompiledCatalog& catalog_;
  const Reporter& reporter_;
  const OnContradiction& on_contradiction_;
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
