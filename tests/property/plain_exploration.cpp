#include "plain_exploration.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include "demand.h"

namespace cbc::plain {
namespace {

using oracle::demand;

std::set<std::uint32_t> variables_of(const std::vector<const Property*>& properties) {
  std::set<std::uint32_t> variables;
  for (const Property* const property : properties) variables.merge(cbc::variables_of(*property));
  return variables;
}

class PlainSearch {
 public:
  PlainSearch(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
              const Assumptions& assumptions, const std::vector<const Property*>& properties)
      : catalog_(catalog),
        model_(catalog, groups, assumptions, variables_of(properties)),
        properties_(properties),
        marking_(!properties.empty() && properties.front()->after ? properties.front() : nullptr),
        has_counted_(properties.size(), false) {
    result_.groups = groups;
    result_.verdicts.resize(properties.size());
    result_.outcomes.emplace();
  }

  Exploration run(std::uint64_t max_states) && {
    Snapshot first = model_.first_state();
    if (model_.is_excluded(first)) {
      result_.error = "the first state is excluded";
      return std::move(result_);
    }
    add(std::move(first), 0, {});
    for (std::size_t place = 0; place < nodes_.size(); ++place) {
      if (nodes_.size() > max_states) {
        end_early(nodes_[place].depth);
        return std::move(result_);
      }
      observe(place);
      expand(place);
    }
    result_.complete = true;
    result_.depth = nodes_.back().depth;
    report();
    return std::move(result_);
  }

 private:
  struct Node {
    Snapshot state;
    std::size_t parent = 0;
    Move move;  ///< from the parent
    std::uint32_t depth = 0;
    bool mark = false;  ///< see Property::after
    /// If some property asks for what stays possible.
    std::vector<std::pair<Move, std::size_t>> successors;
  };

  /// Returns the place of the state.
  std::size_t add(Snapshot state, std::size_t parent, const Move& move) {
    const bool mark = marking_ != nullptr && is_marked(state, parent);
    const auto [known, is_new] =
        places_.emplace(model_.key(state) + (mark ? "marked" : ""), nodes_.size());
    if (!is_new) return known->second;
    const auto problem = find_inconsistency(catalog_, state);
    demand(!problem, "a state is inconsistent: " + problem.value_or(""));
    const std::uint32_t depth = nodes_.empty() ? 0 : nodes_[parent].depth + 1;
    result_.states_at_depth.resize(depth + 1);
    ++result_.states_at_depth[depth];
    nodes_.push_back({std::move(state), parent, move, depth, mark, {}});
    return nodes_.size() - 1;
  }

  [[nodiscard]] bool is_marked(const Snapshot& state, std::size_t parent) const {
    if (marking_->until && model_.holds(*marking_->until, state)) return false;
    return model_.holds(*marking_->after, state) || (!nodes_.empty() && nodes_[parent].mark);
  }

  void expand(std::size_t place) {
    const Snapshot state = nodes_[place].state;  // the nodes may move
    for (const Move& move : model_.moves(state)) {
      const Step step = model_.step(state, move);
      if (!step.exists) continue;
      ++result_.transitions;
      const Snapshot& next = step.next;
      for (std::size_t i = 0; i < properties_.size(); ++i) judge_move(i, place, move, next);
      const std::size_t target = add(next, place, move);
      nodes_[place].successors.emplace_back(move, target);
    }
  }

  void judge_move(std::size_t number, std::size_t place, const Move& move, const Snapshot& next) {
    const Property& property = *properties_[number];
    Verdict& verdict = result_.verdicts[number];
    if (property.kind != Property::Kind::keeps_running || verdict.has_script) return;
    const Snapshot& state = nodes_[place].state;
    if (property.when && !model_.holds(*property.when, state)) return;
    if (property.by && !is_of_kinds(*property.by, move)) return;
    const auto* const running = find_running(state, property.task);
    if (running == nullptr || !running->request || running->request->priority < 1) return;
    if (find_running(next, property.task) != nullptr) return;
    const std::uint32_t behavior =
        catalog_.behaviors[catalog_.values[property.task][running->value_index].behavior]
            .catalog_index;
    const bool is_finish = move.kind == Move::Kind::success || move.kind == Move::Kind::failure ||
                           move.kind == Move::Kind::situation_change;
    if (is_finish && move.subject == behavior) return;
    const std::uint32_t task = catalog_.tasks[property.task].catalog_index;
    if (move.kind == Move::Kind::stop && move.subject == task) return;
    write_script(place, verdict);
    verdict.script.push_back(move);
  }

  [[nodiscard]] bool is_of_kinds(const MoveKinds& kinds, const Move& move) const {
    const auto names = [&](const std::vector<TaskId>& tasks) {
      return tasks.empty() ||
             std::count(tasks.begin(), tasks.end(), catalog_.task_ids[move.subject]) > 0;
    };
    switch (move.kind) {
      case Move::Kind::start:
        return kinds.start && names(kinds.start_only);
      case Move::Kind::stop:
        return kinds.stop && names(kinds.stop_only);
      case Move::Kind::success:
        return kinds.successes;
      case Move::Kind::failure:
        return kinds.failures;
      case Move::Kind::fault:
        return kinds.fault;
      case Move::Kind::repair:
        return kinds.repair;
      case Move::Kind::due:
        return kinds.queue;
      default:
        return kinds.situation;
    }
  }

  /// The states from which one that satisfies the condition can be reached.
  [[nodiscard]] std::vector<bool> can_reach(const Property& property) const {
    std::vector<bool> can(nodes_.size());
    for (std::size_t place = 0; place < nodes_.size(); ++place) {
      can[place] = model_.holds(property.condition, nodes_[place].state);
    }
    for (std::uint32_t moves = 0; !property.within || moves < *property.within; ++moves) {
      std::vector<bool> next = can;
      for (std::size_t place = 0; place < nodes_.size(); ++place) {
        for (const auto& [move, target] : nodes_[place].successors) {
          if (can[target] && (!property.by || is_of_kinds(*property.by, move))) next[place] = true;
        }
      }
      if (next == can) break;
      can = std::move(next);
    }
    return can;
  }

  void judge_possibility(const Property& property, Verdict& verdict) {
    const std::vector<bool> can = can_reach(property);
    for (std::size_t place = 0; place < nodes_.size(); ++place) {
      if (can[place] || !counts(property, nodes_[place])) continue;
      write_script(place, verdict);
      return;
    }
  }

  [[nodiscard]] bool counts(const Property& property, const Node& node) const {
    return (!property.settled || node.state.queue.empty()) && (!property.after || node.mark) &&
           (!property.when || model_.holds(*property.when, node.state));
  }

  /// Of the first state with these tasks and behaviors.
  void add_outcome(std::size_t place) {
    const Snapshot& state = nodes_[place].state;
    ReachableOutcome outcome;
    for (const TaskId task : model_.tasks()) {
      const auto* const running = find_running(state, task);
      if (running == nullptr) continue;
      const BehaviorId behavior = catalog_.values[task][running->value_index].behavior;
      outcome.running.emplace_back(catalog_.tasks[task].catalog_index,
                                   catalog_.behaviors[behavior].catalog_index);
    }
    if (!outcomes_.insert(outcome.running).second) return;
    outcome.script = script_to(place);
    for (const std::uint32_t variable : model_.variables()) {
      outcome.situation.variables.push_back({variable, state.variables[variable]});
    }
    for (const BehaviorId behavior : model_.own()) {
      outcome.situation.behaviors.push_back({behavior, !oracle::contains(state.denied, behavior)});
    }
    for (const BehaviorId behavior : model_.behaviors()) {
      if (oracle::contains(state.faulty, behavior)) outcome.faulty.push_back(behavior);
    }
    result_.outcomes->push_back(std::move(outcome));
  }

  void observe(std::size_t place) {
    const Node& node = nodes_[place];
    const Snapshot& state = node.state;
    if (state.queue.empty()) add_outcome(place);
    std::vector<std::uint32_t> running;
    for (const TaskId task : model_.tasks()) {
      const std::uint32_t index = catalog_.tasks[task].catalog_index;
      if (find_running(state, task) != nullptr) {
        running.push_back(index);
        runs_.emplace(index, node.depth);
      } else if (catalog_.tasks[task].start_on_request != 0 && !start_refused_.contains(index) &&
                 !is_accepted(state, task, 1)) {
        start_refused_.emplace(index, node.depth);
      }
    }
    for (std::size_t a = 0; a < running.size(); ++a) {
      for (std::size_t b = a + 1; b < running.size(); ++b) {
        together_.emplace(std::pair(running[a], running[b]), node.depth);
      }
    }
    for (const BehaviorId behavior : model_.behaviors()) {
      if (is_active(state, behavior)) {
        active_.emplace(catalog_.behaviors[behavior].catalog_index, node.depth);
      }
    }
    for (std::size_t i = 0; i < properties_.size(); ++i) {
      if (counts(*properties_[i], node)) has_counted_[i] = true;
      if (!result_.verdicts[i].has_script) judge(*properties_[i], place, result_.verdicts[i]);
    }
  }

  [[nodiscard]] bool is_accepted(const Snapshot& state, TaskId task, std::int32_t priority) const {
    const Move start{Move::Kind::start, catalog_.tasks[task].catalog_index, priority};
    return model_.step(state, start).outcome == Outcome::accepted;
  }

  /// Ends the verdict if the state is a counterexample, or the witness.
  void judge(const Property& property, std::size_t place, Verdict& verdict) const {
    const Snapshot& state = nodes_[place].state;
    if (!counts(property, nodes_[place])) return;
    bool is_found = false;
    switch (property.kind) {
      case Property::Kind::can_start:
        is_found = find_running(state, property.task) == nullptr &&
                   !is_accepted(state, property.task, property.priority);
        break;
      case Property::Kind::always:
        is_found = !model_.holds(property.condition, state);
        break;
      case Property::Kind::never:
      case Property::Kind::reachable:
        is_found = model_.holds(property.condition, state);
        break;
      case Property::Kind::keeps_running:
      case Property::Kind::always_possible:
        break;
    }
    if (!is_found) return;
    write_script(place, verdict);
    if (property.kind == Property::Kind::can_start) {
      verdict.script.push_back(
          {Move::Kind::start, catalog_.tasks[property.task].catalog_index, property.priority});
    }
  }

  [[nodiscard]] std::vector<Move> script_to(std::size_t place) const {
    std::vector<Move> script;
    for (std::size_t at = place; at != 0; at = nodes_[at].parent) {
      script.push_back(nodes_[at].move);
    }
    std::reverse(script.begin(), script.end());
    return script;
  }

  void write_script(std::size_t place, Verdict& verdict) const {
    verdict.has_script = true;
    verdict.script = script_to(place);
  }

  /// Of the states at the depth some are not expanded, but all are known.
  void end_early(std::uint32_t depth) {
    result_.depth = depth - 1;
    report();
    result_.states_at_depth.resize(depth + 1);
  }

  void report() {
    result_.states = nodes_.size();
    result_.runs.assign(runs_.begin(), runs_.end());
    result_.active.assign(active_.begin(), active_.end());
    std::sort(result_.outcomes->begin(), result_.outcomes->end(), [](const auto& a, const auto& b) {
      return std::pair(a.script.size(), a.running) < std::pair(b.script.size(), b.running);
    });
    result_.start_refused.assign(start_refused_.begin(), start_refused_.end());
    for (const auto& [pair, depth] : together_) {
      result_.together.push_back({pair.first, pair.second, depth});
    }
    for (std::size_t i = 0; i < properties_.size(); ++i) {
      const Property& property = *properties_[i];
      Verdict& verdict = result_.verdicts[i];
      if (result_.complete && property.kind == Property::Kind::always_possible) {
        judge_possibility(property, verdict);
      }
      if (!result_.complete && !verdict.has_script) continue;
      const bool is_reachable = property.kind == Property::Kind::reachable;
      verdict.result =
          verdict.has_script == is_reachable ? Verdict::Result::proved : Verdict::Result::violated;
      verdict.is_vacuous = verdict.result == Verdict::Result::proved && !has_counted_[i] &&
                           (property.when || property.after);
    }
  }

  const CompiledCatalog& catalog_;
  PlainModel model_;
  const std::vector<const Property*>& properties_;
  const Property* marking_;        ///< the one with a mark, or null
  std::vector<bool> has_counted_;  ///< by property: some state did
  std::vector<Node> nodes_;
  std::unordered_map<std::string, std::size_t> places_;  ///< by key
  // By place in the catalog: the least depth.
  std::map<std::uint32_t, std::uint32_t> runs_;
  std::map<std::uint32_t, std::uint32_t> active_;
  std::map<std::uint32_t, std::uint32_t> start_refused_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> together_;
  std::set<std::vector<std::pair<std::uint32_t, std::uint32_t>>> outcomes_;  ///< what runs
  Exploration result_;
};

}  // namespace

Exploration explore_plainly(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
                            const Assumptions& assumptions,
                            const std::vector<const Property*>& properties,
                            std::uint64_t max_states) {
  return PlainSearch(catalog, groups, assumptions, properties).run(max_states);
}

}  // namespace cbc::plain
