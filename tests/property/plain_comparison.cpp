#include "plain_comparison.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "demand.h"
#include "plain_model.h"

namespace cbc::plain {

using oracle::contains;

namespace {

std::string named(const CompiledCatalog& catalog, const VisibleState& state) {
  std::set<std::string> running;
  for (const auto& [task, behavior] : state.running) {
    running.insert(std::string(catalog.name_of_task(task)) + ":" +
                   std::string(catalog.name_of_behavior(behavior)));
  }
  const auto names = [&](const std::vector<TaskId>& tasks) {
    std::set<std::string> sorted;
    for (const TaskId task : tasks) sorted.emplace(catalog.name_of_task(task));
    std::string text;
    for (const std::string& name : sorted) text += " " + name;
    return text;
  };
  std::string text = "; running";
  for (const std::string& one : running) text += " " + one;
  text += "; queue";
  for (const auto& set : state.queue) text += names(set) + ",";
  return text + "; waiting" + names(state.waiting);
}

/// The numbers of one catalog for those of another; nothing for what it does not have.
class Names {
 public:
  Names(const CompiledCatalog& from, const CompiledCatalog& to) : from_(from), to_(to) {}

  [[nodiscard]] std::optional<TaskId> task(TaskId id) const {
    const auto found = to_.find_task(from_.name_of_task(id));
    return found ? std::optional(to_.task_ids[*found]) : std::nullopt;
  }
  [[nodiscard]] std::optional<BehaviorId> behavior(BehaviorId id) const {
    const auto found = to_.find_behavior(from_.name_of_behavior(id));
    return found ? std::optional(to_.behavior_ids[*found]) : std::nullopt;
  }
  [[nodiscard]] std::optional<VariableValue> value(VariableValue value) const {
    const auto variable = to_.find_variable(from_.name_of_variable(value.variable));
    if (!variable) return std::nullopt;
    const auto found = to_.find_value(*variable, from_.name_of_value(value));
    return found ? std::optional(VariableValue{*variable, *found}) : std::nullopt;
  }

  [[nodiscard]] std::optional<Move> move(Move move) const {
    switch (move.kind) {
      case Move::Kind::due:
        return move;
      case Move::Kind::start:
      case Move::Kind::stop: {
        const auto found = to_.find_task(from_.task_names[move.subject]);
        if (!found) return std::nullopt;
        move.subject = *found;
        return move;
      }
      case Move::Kind::variable: {
        const auto found = value({move.subject, static_cast<std::uint32_t>(move.choice)});
        if (!found) return std::nullopt;
        return Move{move.kind, found->variable, static_cast<std::int32_t>(found->value)};
      }
      default: {
        const auto found = to_.find_behavior(from_.behavior_names[move.subject]);
        if (!found) return std::nullopt;
        move.subject = *found;
        return move;
      }
    }
  }

  [[nodiscard]] Assumptions assumptions(const Assumptions& from) const {
    Assumptions result = from;
    result.start.clear();
    for (const Assumptions::Start& start : from.start) {
      if (const auto id = task(start.task)) result.start.push_back({*id, start.priorities});
    }
    result.stop.clear();
    for (const TaskId one : from.stop) {
      if (const auto id = task(one)) result.stop.push_back(*id);
    }
    result.variables.clear();
    for (const std::uint32_t one : from.variables) {
      if (const auto found = to_.find_variable(from_.name_of_variable(one))) {
        result.variables.push_back(*found);
      }
    }
    result.behaviors.clear();
    for (const BehaviorId one : from.behaviors) {
      if (const auto id = behavior(one)) result.behaviors.push_back(*id);
    }
    result.never.clear();
    for (const SituationPart& entry : from.never) {
      const SituationPart translated = part(entry);
      if (translated.variables.size() == entry.variables.size() &&
          translated.behaviors.size() == entry.behaviors.size()) {
        result.never.push_back(translated);
      }
    }
    result.initially = part(from.initially);
    return result;
  }

 private:
  [[nodiscard]] SituationPart part(const SituationPart& from) const {
    SituationPart result;
    for (const VariableValue& one : from.variables) {
      if (const auto translated = value(one)) result.variables.push_back(*translated);
    }
    for (const SituationPart::Own& own : from.behaviors) {
      if (const auto id = behavior(own.behavior)) result.behaviors.push_back({*id, own.available});
    }
    return result;
  }

  const CompiledCatalog& from_;
  const CompiledCatalog& to_;
};

struct Groups {
  std::vector<GroupId> of_old;
  std::vector<GroupId> of_new;
};

/// Puts groups together that have a name in common, until no two are left that have.
std::vector<Groups> join_groups(const CompiledCatalog& old_catalog,
                                const CompiledCatalog& new_catalog) {
  struct Named {
    Groups groups;
    std::set<std::string> names;
  };
  std::vector<Named> all;
  const auto add = [&](const CompiledCatalog& catalog, bool is_new) {
    for (GroupId group(0); group < catalog.group_count(); ++group) {
      Named& one = all.emplace_back();
      (is_new ? one.groups.of_new : one.groups.of_old).push_back(group);
      for (const TaskId task : catalog.task_ids) {
        if (catalog.tasks[task].group != group) continue;
        one.names.insert("task " + std::string(catalog.name_of_task(task)));
      }
      for (const BehaviorId behavior : catalog.behavior_ids) {
        if (catalog.group_of(behavior) != group) continue;
        one.names.insert("behavior " + std::string(catalog.name_of_behavior(behavior)));
      }
    }
  };
  add(new_catalog, true);
  add(old_catalog, false);
  const auto meet = [](const Named& a, const Named& b) {
    return std::any_of(a.names.begin(), a.names.end(),
                       [&](const std::string& name) { return b.names.contains(name); });
  };
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = a + 1; b < all.size();) {
      if (!meet(all[a], all[b])) {
        ++b;
        continue;
      }
      const auto append = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
      };
      append(all[a].groups.of_old, all[b].groups.of_old);
      append(all[a].groups.of_new, all[b].groups.of_new);
      all[a].names.insert(all[b].names.begin(), all[b].names.end());
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(b));
      b = a + 1;
    }
  }
  std::vector<Groups> result;
  for (Named& one : all) {
    std::sort(one.groups.of_old.begin(), one.groups.of_old.end());
    std::sort(one.groups.of_new.begin(), one.groups.of_new.end());
    result.push_back(std::move(one.groups));
  }
  return result;
}

/// How moves are compared.
using Place = std::tuple<Move::Kind, std::uint32_t, std::ptrdiff_t>;

class PairSearch {
 public:
  PairSearch(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
             const Groups& groups, const Assumptions& old_assumptions,
             const Assumptions& new_assumptions, PlainDifferences differences)
      : differences_(differences),
        to_old_(new_catalog, old_catalog),
        to_new_(old_catalog, new_catalog),
        old_(old_catalog, groups.of_old, old_assumptions),
        new_(new_catalog, groups.of_new, new_assumptions) {}

  [[nodiscard]] bool run(std::uint64_t max_states, PlainComparison& result) {
    Node first{new_.first_state(), old_.first_state(), 0, {}, 0};
    if (new_.is_excluded(first.of_new) || old_.is_excluded(first.of_old)) {
      result.has_error = true;
      return true;
    }
    add(std::move(first));
    for (std::size_t place = 0; place < nodes_.size(); ++place) {
      if (nodes_.size() > max_states) return false;
      if (expand(place, result)) return true;
    }
    result.states += nodes_.size();
    result.depth = std::max(result.depth, nodes_.back().depth);
    return true;
  }

  [[nodiscard]] Place place_of(const Move& move) const {
    std::ptrdiff_t choice = move.choice;
    if (move.kind == Move::Kind::start) {
      for (const Assumptions::Start& start : new_.assumptions().start) {
        if (new_.catalog().tasks[start.task].catalog_index != move.subject) continue;
        choice = std::find(start.priorities.begin(), start.priorities.end(), move.choice) -
                 start.priorities.begin();
      }
    }
    return {move.kind, move.subject, choice};
  }

 private:
  struct Node {
    Snapshot of_new;
    Snapshot of_old;
    std::size_t parent = 0;
    Move move;
    std::uint32_t depth = 0;
  };

  void add(Node node) {
    const std::string key = new_.key(node.of_new) + "/ " + old_.key(node.of_old);
    if (places_.emplace(key, nodes_.size()).second) nodes_.push_back(std::move(node));
  }

  /// The moves of both, as far as both know what they name, by the numbers of the new catalog.
  [[nodiscard]] std::vector<Move> moves_of(const Node& node) const {
    std::vector<Move> moves;
    for (const Move& move : new_.moves(node.of_new)) {
      if (to_old_.move(move)) moves.push_back(move);
    }
    for (const Move& move : old_.moves(node.of_old)) {
      const auto translated = to_new_.move(move);
      if (translated && !contains(moves, *translated)) moves.push_back(*translated);
    }
    std::sort(moves.begin(), moves.end(),
              [&](const Move& a, const Move& b) { return place_of(a) < place_of(b); });
    return moves;
  }

  /// What the move does to one of the two; nothing if it is about an empty queue.
  [[nodiscard]] static Snapshot step(const PlainModel& model, const Snapshot& state,
                                     const Move& move, std::vector<Happening>& happenings) {
    if (move.kind == Move::Kind::due && state.queue.empty()) return state;
    return model.step(state, move, &happenings).next;
  }

  [[nodiscard]] std::vector<std::string> observe(const PlainModel& model, const Move& move,
                                                 const std::vector<Happening>& happenings,
                                                 const Snapshot& end) const {
    std::vector<std::string> lines;
    if (differences_ == PlainDifferences::expectable) {
      if (move.kind <= Move::Kind::situation_change) {
        lines.emplace_back(name_of(happenings.front().outcome));
      }
      VisibleState visible = model.visible(end);
      visible.queue.clear();
      visible.waiting.clear();
      lines.push_back(named(model.catalog(), visible));
      return lines;
    }
    for (const Happening& one : happenings) lines.push_back(named(model.catalog(), one));
    lines.push_back(named(model.catalog(), model.visible(end)));
    return lines;
  }

  /// True if a move differs, which ends the search.
  [[nodiscard]] bool expand(std::size_t place, PlainComparison& result) {
    const Node node = nodes_[place];  // the nodes may move
    for (const Move& move : moves_of(node)) {
      std::vector<Happening> of_new;
      std::vector<Happening> of_old;
      Node next{step(new_, node.of_new, move, of_new),
                step(old_, node.of_old, to_old_.move(move).value(), of_old), place, move,
                node.depth + 1};
      if (new_.is_excluded(next.of_new) || old_.is_excluded(next.of_old)) continue;
      ++result.transitions;
      if (observe(new_, move, of_new, next.of_new) != observe(old_, move, of_old, next.of_old)) {
        note_difference(place, move, result);
        return true;
      }
      add(std::move(next));
    }
    return false;
  }

  void note_difference(std::size_t place, const Move& move, PlainComparison& result) const {
    std::vector<Move> moves{move};
    for (std::size_t at = place; at != 0; at = nodes_[at].parent) moves.push_back(nodes_[at].move);
    std::reverse(moves.begin(), moves.end());
    const auto comes_first = [&](const std::vector<Move>& a, const std::vector<Move>& b) {
      if (a.size() != b.size()) return a.size() < b.size();
      return std::lexicographical_compare(
          a.begin(), a.end(), b.begin(), b.end(),
          [&](const Move& one, const Move& other) { return place_of(one) < place_of(other); });
    };
    if (result.differs && !comes_first(moves, result.moves)) return;
    result.differs = true;
    result.moves = std::move(moves);
  }

  const PlainDifferences differences_;
  Names to_old_;
  Names to_new_;
  PlainModel old_;
  PlainModel new_;
  std::deque<Node> nodes_;
  std::unordered_map<std::string, std::size_t> places_;  ///< by key
};

}  // namespace

std::string named(const CompiledCatalog& catalog, const Happening& happening) {
  std::string text(name_of(happening.verb));
  text.append(" ").append(name_of(happening.origin));
  if (happening.task != none) text.append(" ").append(catalog.name_of_task(happening.task));
  if (happening.behavior != none) {
    text.append(" ").append(catalog.name_of_behavior(happening.behavior));
  }
  text.append(" ").append(name_of(happening.outcome));
  for (const Happening::Change& change : happening.changes) {
    text += change.is_activation ? " +" : " -";
    text.append(catalog.name_of_behavior(change.behavior)).append(change.success ? "" : "!");
  }
  std::set<std::string> stopped;
  for (const auto& [task, cause] : happening.stopped) {
    stopped.insert(std::string(catalog.name_of_task(task)) + " " + std::string(name_of(cause)));
  }
  for (const std::string& one : stopped) text += "; stopped " + one;
  return text + named(catalog, happening.after);
}

PlainComparison compare_plainly(const CompiledCatalog& old_catalog,
                                const CompiledCatalog& new_catalog, const Assumptions& assumptions,
                                std::uint64_t max_states, PlainDifferences differences) {
  PlainComparison result;
  result.is_complete = true;
  const Assumptions of_old = Names(new_catalog, old_catalog).assumptions(assumptions);
  const Assumptions of_new = Names(old_catalog, new_catalog).assumptions(of_old);
  for (const Groups& groups : join_groups(old_catalog, new_catalog)) {
    PairSearch search(old_catalog, new_catalog, groups, of_old, of_new, differences);
    if (!search.run(max_states, result)) result.is_complete = false;
    if (result.has_error) return result;
  }
  return result;
}

}  // namespace cbc::plain
