#include "plain_exploration.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
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
        properties_(properties) {
    result_.groups = groups;
    result_.verdicts.resize(properties.size());
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
  };

  void add(Snapshot state, std::size_t parent, const Move& move) {
    if (!places_.emplace(model_.key(state), nodes_.size()).second) return;
    const auto problem = find_inconsistency(catalog_, state);
    demand(!problem, "a state is inconsistent: " + problem.value_or(""));
    const std::uint32_t depth = nodes_.empty() ? 0 : nodes_[parent].depth + 1;
    result_.states_at_depth.resize(depth + 1);
    ++result_.states_at_depth[depth];
    nodes_.push_back({std::move(state), parent, move, depth});
  }

  void expand(std::size_t place) {
    const Snapshot state = nodes_[place].state;  // the nodes may move
    for (const Move& move : model_.moves(state)) {
      ++result_.transitions;
      add(model_.step(state, move).next, place, move);
    }
  }

  void observe(std::size_t place) {
    const Node& node = nodes_[place];
    const Snapshot& state = node.state;
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
    if (property.settled && !state.queue.empty()) return;
    if (property.when && !model_.holds(*property.when, state)) return;
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
    }
    if (!is_found) return;
    verdict.has_script = true;
    for (std::size_t at = place; at != 0; at = nodes_[at].parent) {
      verdict.script.push_back(nodes_[at].move);
    }
    std::reverse(verdict.script.begin(), verdict.script.end());
    if (property.kind == Property::Kind::can_start) {
      verdict.script.push_back(
          {Move::Kind::start, catalog_.tasks[property.task].catalog_index, property.priority});
    }
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
    result_.start_refused.assign(start_refused_.begin(), start_refused_.end());
    for (const auto& [pair, depth] : together_) {
      result_.together.push_back({pair.first, pair.second, depth});
    }
    for (std::size_t i = 0; i < properties_.size(); ++i) {
      if (!result_.complete && !result_.verdicts[i].has_script) continue;
      const bool is_reachable = properties_[i]->kind == Property::Kind::reachable;
      result_.verdicts[i].result = result_.verdicts[i].has_script == is_reachable
                                       ? Verdict::Result::proved
                                       : Verdict::Result::violated;
    }
  }

  const CompiledCatalog& catalog_;
  PlainModel model_;
  const std::vector<const Property*>& properties_;
  std::vector<Node> nodes_;
  std::unordered_map<std::string, std::size_t> places_;  ///< by key
  // By place in the catalog: the least depth.
  std::map<std::uint32_t, std::uint32_t> runs_;
  std::map<std::uint32_t, std::uint32_t> active_;
  std::map<std::uint32_t, std::uint32_t> start_refused_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> together_;
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
