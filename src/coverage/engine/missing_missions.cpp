#include "coverage/engine/missing_missions.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/script/runner.h"
#include "coverage/engine/goal_proof.h"
#include "coverage/engine/mission_plan.h"
#include "coverage/engine/simulated_run.h"

namespace cbc {
namespace {

using Goals = MissionPlanner::Goals;
using Phase = MissingMissions::Phase;

constexpr const char* stopped_before = "no test was found before the end";

bool is_any(const Goals& goals) {
  return std::any_of(goals.begin(), goals.end(), [](std::uint8_t goal) { return goal != 0; });
}

class MissionFinder {
 public:
  MissionFinder(const CompiledCatalog& catalog, std::span<const Goal> goals,
                const Assumptions& assumptions, const MissingMissionOptions& options)
      : catalog_(catalog),
        goals_(goals),
        assumptions_(assumptions),
        options_(options),
        bound_(bound_variables(catalog, assumptions)),
        simulator_(catalog, goals, assumptions, options.is_over) {}

  MissingMissions find(const std::vector<std::uint8_t>& met) {
    missing_.assign(goals_.size(), 0);
    for (std::size_t goal = 0; goal < goals_.size(); ++goal) {
      missing_[goal] = met[goal] == 0 ? 1 : 0;
      result_.wanted += missing_[goal];
    }
    result_.reached = Phase::exploration;
    graph_ = explore_goals(catalog_, goals_, missing_, assumptions_, options_.exploration);
    result_.error = graph_.error;
    result_.states = graph_.state_count();
    if (graph_.error) return std::move(result_);
    note_partial();
    go_on_to(Phase::planning);
    const auto stop = [this] {
      show_progress();
      return is_stopped();
    };
    MissionPlanner planner(graph_, options_.events, stop);
    set_apart(planner);
    if (result_.is_explored() && !is_stopped()) {
      result_.lower_bound = planner.lower_bound(bounded());
    }
    for (std::uint32_t part = 0; part < graph_.parts.size(); ++part) {
      result_.most_events = std::max(result_.most_events, planner.most_events(part));
    }
    perform(planner, missing_);
    if (!is_stopped()) wait_for_timeouts(planner);
    perform(planner, missing_timeouts(false));
    go_on_to(Phase::done);
    show_first_values();
    list_unmet();
    return std::move(result_);
  }

 private:
  /// Unless it is stopped in the present one.
  void go_on_to(Phase phase) {
    if (!is_stopped()) result_.reached = phase;
  }

  void note_partial() {
    for (const GoalGraph::Part& part : graph_.parts) {
      if (part.is_complete) continue;
      if (part.variable != none) {
        result_.partial_variables.push_back(part.variable);
      } else {
        result_.partial.push_back(part.group);
      }
    }
    result_.unexplored = GroupId(static_cast<std::uint32_t>(graph_.explored_groups()));
    for (GroupId group = result_.unexplored; group < catalog_.group_count(); ++group) {
      result_.partial.push_back(group);
    }
  }
  /// Whether all is known of the moves that may meet the goal. Returns are sought after the
  /// exploration, and variables that no behavior names belong to the first group.
  [[nodiscard]] bool is_explored(const Goal& goal) const {
    if (goal.kind == Goal::Kind::reactive_returned && is_stopped()) return false;
    const std::vector<GroupId> groups = groups_of(catalog_, goal);
    if (std::binary_search(bound_.begin(), bound_.end(), goal.variable)) {
      const auto shows_all = [&](const GoalGraph::Part& part) {
        return part.variable == goal.variable && part.is_complete;
      };
      return catalog_.group_count() == 0 ||
             std::any_of(graph_.parts.begin(), graph_.parts.end(), shows_all);
    }
    if (groups.empty()) return result_.unexplored > 0 || catalog_.group_count() == 0;
    return std::none_of(groups.begin(), groups.end(), [&](GroupId group) {
      return std::binary_search(result_.partial.begin(), result_.partial.end(), group);
    });
  }

  /// Sets apart what is unreachable, and what each script meets as it begins.
  void set_apart(const MissionPlanner& planner) {
    first_values_.assign(goals_.size(), 0);
    for (std::size_t number = 0; number < goals_.size(); ++number) {
      const Goal& goal = goals_[number];
      if (missing_[number] == 0) continue;
      if (goal.kind == Goal::Kind::variable_value &&
          initial_value(assumptions_, goal.variable) == goal.value) {
        first_values_[number] = 1;
        missing_[number] = 0;
      } else if (planner.reachable()[number] == 0 || is_forestalled(catalog_, goal, graph_.facts)) {
        missing_[number] = 0;
        const auto place = static_cast<std::uint32_t>(number);
        if (is_explored(goal)) {
          result_.unreachable.push_back(
              {place, why_unreachable(catalog_, goals_, number, assumptions_, graph_.facts)});
        } else {
          result_.unmet.push_back({place, is_stopped()
                                              ? stopped_before
                                              : "not met before a limit ended the exploration"});
        }
      }
    }
  }

  [[nodiscard]] std::vector<Move> moves_of(const MissionPlanner::Path& path) const {
    std::vector<Move> moves;
    for (const std::uint32_t edge : path.edges) moves.push_back(graph_.edges[edge].move);
    return moves;
  }

  /// What no script about another group meets by the way. Reactive tasks of all groups start by
  /// themselves in every script, and what comes of it depends on times.
  [[nodiscard]] Goals bounded() const {
    Goals bounded = missing_;
    if (graph_.explored_groups() < 2) return bounded;
    std::set<GroupId> lively;
    for (const CompiledTask& task : catalog_.tasks) {
      if (task.reactive_start != 0) lively.insert(task.group);
    }
    for (std::size_t number = 0; number < goals_.size(); ++number) {
      const Goal& goal = goals_[number];
      const bool needs_request = goal.kind == Goal::Kind::behavior_succeeded ||
                                 goal.kind == Goal::Kind::higher_displaced ||
                                 goal.kind == Goal::Kind::lower_rejected ||
                                 goal.kind == Goal::Kind::equal_displaced;
      if (needs_request || goal.variable != none) continue;
      const GroupId group =
          goal.task != none ? catalog_.tasks[goal.task].group : catalog_.group_of(goal.behavior);
      if (lively.contains(group)) bounded[number] = 0;
    }
    return bounded;
  }

  /// Adds scripts that meet these goals. Where other timeouts come first, those do not fire.
  void perform(MissionPlanner& planner, const Goals& wanted) {
    for (const MissionPlanner::Path& path : planner.plan(wanted)) {
      show_progress();
      if (is_over()) return;
      go_on_to(Phase::simulation);
      std::vector<std::uint8_t> is_timeout;
      for (const std::uint32_t edge : path.edges) {
        const auto items = graph_.items_of(graph_.edges[edge]);
        is_timeout.push_back(std::any_of(items.begin(), items.end(), [&](std::uint32_t item) {
          return item < goals_.size() && wanted[item] != 0 && missing_[item] != 0 &&
                 goals_[item].kind == Goal::Kind::timeout_fired;
        }));
      }
      const GroupId group = graph_.parts[path.part].group;
      add(is_any(is_timeout) ? simulator_.run_by_clock(group, moves_of(path), is_timeout)
                             : simulator_.run(group, moves_of(path)));
    }
  }

  /// What is missing of the timeouts, or of all other goals.
  [[nodiscard]] Goals missing_timeouts(bool are_timeouts = true) const {
    Goals wanted = missing_;
    for (std::size_t goal = 0; goal < goals_.size(); ++goal) {
      if ((goals_[goal].kind == Goal::Kind::timeout_fired) != are_timeouts) wanted[goal] = 0;
    }
    return wanted;
  }

  /// States have no times, so what fires in a state is tried out.
  void wait_for_timeouts(const MissionPlanner& planner) {
    constexpr std::size_t most_tries = 200;
    for (Goals wanted = missing_timeouts(); is_any(wanted); wanted = missing_timeouts()) {
      if (!wait_once(planner, wanted, most_tries)) break;
    }
    // Where many timeouts are possible, others may come first.
    const Goals left = missing_timeouts();
    for (std::size_t goal = 0; goal < goals_.size(); ++goal) {
      if (left[goal] == 0 || missing_[goal] == 0) continue;
      Goals one(goals_.size(), 0);
      one[goal] = 1;
      static_cast<void>(wait_once(planner, one, 10 * most_tries));
    }
  }

  /// Adds the script that meets most of these goals; false if none of those tried meets any.
  bool wait_once(const MissionPlanner& planner, const Goals& wanted, std::size_t most_tries) {
    std::optional<SimulatedRun> best;
    std::size_t most = 0;
    for (const MissionPlanner::Path& path : planner.paths_toward(wanted, most_tries)) {
      show_progress();
      if (is_stopped()) return false;
      const std::uint32_t limit = planner.most_events(path.part);
      if (path.edges.size() >= limit) continue;
      SimulatedRun tried =
          simulator_.wait_after(graph_.parts[path.part].group, moves_of(path), wanted,
                                limit - static_cast<std::uint32_t>(path.edges.size()));
      std::size_t count = 0;
      for (const SimulatedRun::Moment& moment : tried.moments) {
        for (const std::uint32_t goal : moment.goals) count += wanted[goal];
      }
      if (count <= most) continue;
      most = count;
      best = std::move(tried);
    }
    if (best) add(*best);
    return best.has_value();
  }

  [[nodiscard]] bool is_stopped() const {
    return options_.exploration.budget.find_end().has_value();
  }
  [[nodiscard]] bool is_over() const { return options_.is_over && options_.is_over(); }

  /// After the exploration, which has a progress of its own.
  void show_progress() const {
    if (options_.on_mission) options_.on_mission(result_.missions.size());
  }

  /// Writes the script, if it meets anything that is missing, and was not cut short.
  void add(SimulatedRun run) {
    if (is_over()) return;
    run.script.catalog = options_.catalog;
    MissingMissions::Mission mission;
    Goals counts(goals_.size(), 0);
    for (const SimulatedRun::Moment& moment : run.moments) {
      for (const std::uint32_t goal : moment.goals) {
        if (missing_[goal] == 0 && first_values_[goal] == 0) continue;
        missing_[goal] = 0;
        first_values_[goal] = 0;
        counts[goal] = 1;
        mission.goals.push_back(goal);
      }
    }
    if (!run.fault.empty()) result_.fault = run.fault;
    if (mission.goals.empty()) return;
    const Goal& last = goals_[mission.goals.back()];
    mission.group = run.group;
    mission.name = unique_name(last);
    WrittenScript written = write_down(catalog_, goals_, run, counts, title_of(last));
    mission.script = std::move(written.script);
    mission.script.file = mission.name;
    mission.text = std::move(written.text);
    for (const Step& step : mission.script.steps) {
      if (!step.expect) ++mission.events;
    }
    check(mission);
    result_.missions.push_back(std::move(mission));
  }

  [[nodiscard]] std::string title_of(const Goal& goal) const {
    std::string title = describe(catalog_, goal);
    title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
    return title + ".";
  }

  std::string unique_name(const Goal& goal) {
    const std::string first = name_after(catalog_, goal);
    std::string name = first;
    for (int number = 2; !names_.insert(name).second; ++number) {
      name = fmt::format("{}-{}", first, number);
    }
    return name;
  }

  void check(const MissingMissions::Mission& mission) {
    SilentRun silent;
    const RunResult result = run_script(catalog_, mission.script, {}, silent);
    if (result.status == Coordinator::Status::ok && result.failed == 0) return;
    result_.fault = fmt::format("a script does not do what was proven:\n{}", mission.text);
  }

  /// The values at the beginning, if nothing else is missing.
  void show_first_values() {
    if (is_any(first_values_) && catalog_.group_count() > 0) add(simulator_.run(GroupId(0), {}));
  }

  void list_unmet() {
    for (std::uint32_t goal = 0; goal < goals_.size(); ++goal) {
      if (missing_[goal] == 0 && first_values_[goal] == 0) continue;
      const bool is_timeout = goals_[goal].kind == Goal::Kind::timeout_fired;
      result_.unmet.push_back(
          {goal, result_.reached != Phase::done ? stopped_before
                 : is_timeout
                     ? "waiting in the states that were tried did not show it; events at other "
                       "times were not tried"
                     : "no script that was tried shows it"});
    }
    std::sort(result_.unmet.begin(), result_.unmet.end(),
              [](const auto& a, const auto& b) { return a.goal < b.goal; });
  }

  const CompiledCatalog& catalog_;
  const std::span<const Goal> goals_;
  const Assumptions& assumptions_;
  const MissingMissionOptions& options_;
  const std::vector<std::uint32_t> bound_;  ///< see bound_variables()
  const MissionSimulator simulator_;
  GoalGraph graph_;
  MissingMissions result_;
  Goals missing_;       ///< by goal: no mission meets it, and one can
  Goals first_values_;  ///< the same, of those that each script meets as it begins
  std::set<std::string> names_;
};

}  // namespace

MissingMissions find_missing_missions(const CompiledCatalog& catalog, std::span<const Goal> goals,
                                      const std::vector<std::uint8_t>& met,
                                      const Assumptions& assumptions,
                                      const MissingMissionOptions& options) {
  return MissionFinder(catalog, goals, assumptions, options).find(met);
}

}  // namespace cbc
