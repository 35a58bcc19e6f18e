#include "why/unmet.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "why/conflict.h"

namespace cbc {
namespace {

bool demands_stop(const Demand& demand, TaskId task) {
  return demand.task == task && demand.kind == Demand::Kind::stop;
}

/// Looks for the answer in the present state first, then in the moments.
class Inspection {
 public:
  Inspection(const CompiledCatalog& catalog, const State& present, std::span<const Demands> ways)
      : catalog_(catalog), present_(present), ways_(ways) {}

  /// The moments may be null.
  [[nodiscard]] WhyUnmet run(Moment* accepted, Moment* rejected, Explainer& explainer) const;

 private:
  [[nodiscard]] std::vector<BlockedStart> find_blocked(const State* before) const;
  [[nodiscard]] std::vector<BlockedStart::Rival> running_rivals(TaskId task) const;
  [[nodiscard]] bool is_met(const Demand& demand) const;
  [[nodiscard]] bool explains(std::span<const BlockedStart> blocked) const;
  [[nodiscard]] bool explains(const Moment& rejection) const;
  [[nodiscard]] std::vector<Reason> reasons_of(std::span<const BlockedStart> blocked) const;
  [[nodiscard]] std::vector<Reason> reasons_why_unavailable() const;
  [[nodiscard]] TaskId queued_task() const;

  const CompiledCatalog& catalog_;
  const State& present_;
  const std::span<const Demands> ways_;
};

WhyUnmet Inspection::run(Moment* accepted, Moment* rejected, Explainer& explainer) const {
  WhyUnmet answer;
  std::optional<Return> decision;
  if (accepted != nullptr) {
    decision.emplace(catalog_, *accepted);
    answer.before = decision->before();
    answer.last_event = accepted->event.index;
  }
  answer.blocked = find_blocked(answer.before.get());
  if (explains(answer.blocked)) {
    answer.kind = WhyUnmet::Kind::blocked;
    answer.why_not.conflict = reasons_of(answer.blocked);
  } else if (const TaskId queued = queued_task(); queued != none) {
    answer.kind = WhyUnmet::Kind::due;
    answer.queued_task = queued;
    answer.due = present_.queue().due(catalog_.tasks[queued].catalog_index);
  } else if (rejected != nullptr && explains(*rejected)) {
    answer.kind = WhyUnmet::Kind::rejected;
    answer.event = &rejected->event;
    rejected->event.conflict =
        find_conflict(catalog_, rejected->event, Return(catalog_, *rejected).circumstances());
  } else if (accepted == nullptr) {
    answer.why_not.conflict = reasons_why_unavailable();
  } else {
    answer.kind = WhyUnmet::Kind::decided;
    answer.event = &accepted->event;
    answer.why_not.is_cut = accepted->search.result.status != SearchStatus::optimal;
    if (!answer.why_not.is_cut) {
      answer.why_not = explainer.ask(decision->circumstances(), accepted->solution, ways_,
                                     accepted->event.explanation.chosen);
    }
  }
  return answer;
}

/// The first task that should run and is in the queue, or none.
TaskId Inspection::queued_task() const {
  for (const Demands& way : ways_) {
    for (const Demand& demand : way) {
      const std::uint32_t index = catalog_.tasks[demand.task].catalog_index;
      if (demands_run(demand, demand.task) && present_.queue().has(index)) return demand.task;
    }
  }
  return none;
}

/// Reactive tasks that would have to run, and those that could start by themselves since the last
/// decision, whose start would stop what is not to run. `before`: that decision; null: none.
std::vector<BlockedStart> Inspection::find_blocked(const State* before) const {
  std::vector<BlockedStart> blocked;
  const auto add = [&](TaskId task) {
    const bool is_known =
        std::any_of(blocked.begin(), blocked.end(),
                    [task](const BlockedStart& other) { return other.task == task; });
    if (is_known || catalog_.tasks[task].reactive_start == 0 || present_.is_running(task) ||
        !present_.has_available_behavior(task)) {
      return;
    }
    std::vector<BlockedStart::Rival> rivals = running_rivals(task);
    if (!rivals.empty()) blocked.push_back({task, std::move(rivals)});
  };
  for (const Demands& way : ways_) {
    for (const Demand& demand : way) {
      if (is_met(demand)) continue;
      if (!present_.is_running(demand.task)) {
        add(demand.task);
        continue;
      }
      if (before == nullptr) continue;
      for (const std::uint32_t clique : catalog_.task_cliques[demand.task]) {
        for (const TaskId rival : catalog_.cliques[clique]) {
          if (!before->has_available_behavior(rival)) add(rival);
        }
      }
    }
  }
  return blocked;
}

std::vector<BlockedStart::Rival> Inspection::running_rivals(TaskId task) const {
  std::vector<BlockedStart::Rival> rivals;
  for (const std::uint32_t clique : catalog_.task_cliques[task]) {
    for (const TaskId rival : catalog_.cliques[clique]) {
      const bool is_known =
          std::any_of(rivals.begin(), rivals.end(),
                      [rival](const BlockedStart::Rival& other) { return other.task == rival; });
      if (rival == task || is_known || !present_.is_running(rival)) continue;
      rivals.push_back({rival, catalog_.clique_lines[clique]});
    }
  }
  return rivals;
}

bool Inspection::is_met(const Demand& demand) const {
  const std::uint32_t index = present_.value_index(demand.task);
  switch (demand.kind) {
    case Demand::Kind::run:
      return index != none;
    case Demand::Kind::stop:
      return index == none;
    case Demand::Kind::has:
      return index == demand.value_index;
    case Demand::Kind::has_not:
      return index != demand.value_index;
  }
  return false;
}

/// Whether all that one of the ways lacks are starts that are blocked, and stops of their rivals.
bool Inspection::explains(std::span<const BlockedStart> blocked) const {
  const auto is_explained = [&](const Demand& demand) {
    return is_met(demand) ||
           std::any_of(blocked.begin(), blocked.end(), [&](const BlockedStart& start) {
             return start.task == demand.task ||
                    std::any_of(start.rivals.begin(), start.rivals.end(),
                                [&](const BlockedStart::Rival& rival) {
                                  return rival.task == demand.task;
                                });
           });
  };
  return !blocked.empty() && std::any_of(ways_.begin(), ways_.end(), [&](const Demands& way) {
    return std::all_of(way.begin(), way.end(), is_explained);
  });
}

std::vector<Reason> Inspection::reasons_of(std::span<const BlockedStart> blocked) const {
  std::vector<Reason> reasons;
  const auto add = [&reasons](const Reason& reason) {
    if (std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) {
      reasons.push_back(reason);
    }
  };
  for (const BlockedStart& start : blocked) {
    for (const BlockedStart::Rival& rival : start.rivals) {
      Reason exclusion;
      exclusion.kind = Reason::Kind::exclusive;
      std::tie(exclusion.task, exclusion.other_task) = std::minmax(start.task, rival.task);
      exclusion.line = rival.line;
      add(exclusion);
      if (!present_.has_request(rival.task)) continue;
      Reason protection;
      protection.kind = Reason::Kind::is_protected;
      protection.task = rival.task;
      protection.priority = present_.request(rival.task).priority;
      protection.is_from_any_request = true;
      add(protection);
    }
  }
  // The behavior that should perform one of them may be unavailable as well.
  for (const Demands& way : ways_) {
    for (const Demand& demand : way) {
      if (demand.kind != Demand::Kind::has || is_met(demand)) continue;
      const BehaviorId behavior = catalog_.values[demand.task][demand.value_index].behavior;
      if (!present_.is_available(behavior))
        add(reason_of_unavailability(catalog_, present_, behavior));
    }
  }
  return reasons;
}

/// Of reactive tasks that should run.
std::vector<Reason> Inspection::reasons_why_unavailable() const {
  for (const Demands& way : ways_) {
    for (const Demand& demand : way) {
      if (is_met(demand) || present_.is_running(demand.task) ||
          catalog_.tasks[demand.task].reactive_start == 0 ||
          present_.has_available_behavior(demand.task)) {
        continue;
      }
      return reasons_of_unavailability(catalog_, present_, demand.task);
    }
  }
  return {};
}

/// Whether the moment is a rejected start of a task that does not run but should, or a rejected
/// stop of one that should not.
bool Inspection::explains(const Moment& rejection) const {
  const bool is_stop = rejection.trigger.kind == Trigger::Kind::stop;
  const TaskId task = rejection.trigger.task;
  return is_stop == present_.is_running(task) &&
         std::any_of(ways_.begin(), ways_.end(), [&](const Demands& way) {
           return std::any_of(way.begin(), way.end(), [&](const Demand& demand) {
             return is_stop ? demands_stop(demand, task) : demands_run(demand, task);
           });
         });
}

}  // namespace

WhyUnmet why_unmet(const CompiledCatalog& catalog, const State& present, Journal& journal,
                   Explainer& explainer, GroupId group, std::span<const Demands> ways) {
  return Inspection(catalog, present, ways)
      .run(journal.accepted(group), journal.rejected(group), explainer);
}

}  // namespace cbc
