#include "draw/state_marks.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace cbc::draw {
namespace {

/// Which behavior each task has, and whether each behavior has a task.
struct Use {
  Use(const CatalogGraph& graph, const std::vector<RunState::RunningTask>& running)
      : behavior_of_task(graph.tasks.size(), none), is_active(graph.behaviors.size()) {
    for (const RunState::RunningTask& one : running) {
      behavior_of_task[one.task] = one.behavior;
      is_active[one.behavior] = true;
    }
  }
  [[nodiscard]] bool is_running(std::uint32_t task) const { return behavior_of_task[task] != none; }

  std::vector<std::uint32_t> behavior_of_task;
  std::vector<bool> is_active;
};

std::string describe(const RunState::Change& change) {
  std::string text = change.is_activation ? "activat" : "deactivat";
  return change.is_successful ? text + "ed" : text + "ion failed";
}

class Marker {
 public:
  Marker(CatalogGraph& graph, const RunState& state)
      : graph_(graph), state_(state), before_(graph, state.before), now_(graph, state.running) {}

  void run() {
    mark_tasks();
    mark_behaviors();
    mark_links();
    mark_exclusions();
  }

 private:
  [[nodiscard]] Mark mark_of_task(std::uint32_t task) const {
    return mark_of_use(before_.is_running(task), now_.is_running(task));
  }
  [[nodiscard]] Mark mark_of_behavior(std::uint32_t behavior) const {
    return mark_of_use(before_.is_active[behavior], now_.is_active[behavior]);
  }

  void mark_tasks() {
    for (std::uint32_t task = 0; task < graph_.tasks.size(); ++task) {
      CatalogGraph::Task& marked = graph_.tasks[task];
      marked.mark = mark_of_task(task);
      if (marked.mark == Mark::started || marked.mark == Mark::stopped) {
        marked.notes.emplace_back(name_of(marked.mark));
      }
    }
    for (const RunState::RunningTask& one : state_.running) {
      CatalogGraph::Task& task = graph_.tasks[one.task];
      task.priority = one.priority;
      if (one.priority) {
        const std::string origin = *one.priority == 0 ? "reactive start" : "request";
        task.notes.push_back(origin + ", priority " + std::to_string(*one.priority));
      } else if (is_required(one.task)) {
        task.notes.emplace_back("required");
      }
    }
  }

  [[nodiscard]] bool is_required(std::uint32_t task) const {
    const auto requirements = graph_.requirements_of_task[task];
    return std::any_of(requirements.begin(), requirements.end(), [&](std::uint32_t place) {
      return now_.is_active[graph_.requirements[place].behavior];
    });
  }

  void mark_behaviors() {
    for (std::uint32_t behavior = 0; behavior < graph_.behaviors.size(); ++behavior) {
      graph_.behaviors[behavior].mark = mark_of_behavior(behavior);
    }
    if (state_.finished) graph_.behaviors[*state_.finished].notes.emplace_back("finished");
    for (std::size_t place = 0; place < state_.changes.size(); ++place) {
      const RunState::Change& change = state_.changes[place];
      CatalogGraph::Behavior& behavior = graph_.behaviors[change.behavior];
      behavior.notes.push_back(std::to_string(place + 1) + ". " + describe(change));
      // One that was restarted, or had finished.
      const bool is_new = change.is_activation && change.is_successful && !change.is_undoing;
      if (is_new && behavior.mark == Mark::active) behavior.mark = Mark::started;
    }
    note_hindrance(state_.unavailable, "unavailable");
    note_hindrance(state_.faulty, "faulty");
  }

  void note_hindrance(const std::vector<std::uint32_t>& behaviors, const char* note) {
    for (const std::uint32_t place : behaviors) {
      CatalogGraph::Behavior& behavior = graph_.behaviors[place];
      behavior.notes.emplace_back(note);
      if (behavior.mark == Mark::faint) behavior.mark = Mark::unavailable;
    }
  }

  void mark_links() {
    for (CatalogGraph::Performance& link : graph_.performances) {
      link.mark = mark_of_use(before_.behavior_of_task[link.task] == link.behavior,
                              now_.behavior_of_task[link.task] == link.behavior);
    }
    for (CatalogGraph::Requirement& link : graph_.requirements) {
      link.mark = mark_of_behavior(link.behavior);
    }
  }

  /// Lines to what has nothing to do with the state are faint.
  void mark_exclusions() {
    for (std::size_t place = 0; place < graph_.exclusions.items.size(); ++place) {
      const bool is_idle = mark_of_task(graph_.exclusions.items[place]) == Mark::faint;
      graph_.exclusion_marks.items[place] = is_idle ? Mark::faint : Mark::plain;
    }
  }

  CatalogGraph& graph_;
  const RunState& state_;
  const Use before_;
  const Use now_;
};

}  // namespace

void mark_state(CatalogGraph& graph, const RunState& state) { Marker(graph, state).run(); }

}  // namespace cbc::draw
