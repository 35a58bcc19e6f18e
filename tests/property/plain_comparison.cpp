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

using NameMap = std::map<std::string, std::string>;

NameMap inverse(const NameMap& names) {
  NameMap result;
  for (const auto& [from, to] : names) result[to] = from;
  return result;
}

/// What a name is called in the other catalog, if it has it; a name that another one was changed to
/// stands for that alone.
template <typename Has>
std::optional<std::string> other_name(const std::string& name, const NameMap& renames,
                                      const Has& other_has) {
  if (const auto renamed = renames.find(name); renamed != renames.end()) return renamed->second;
  const bool is_taken = std::any_of(renames.begin(), renames.end(),
                                    [&](const auto& renamed) { return renamed.second == name; });
  return !is_taken && other_has(name) ? std::optional(name) : std::nullopt;
}

/// The numbers of one catalog for those of another; nothing for what it does not have.
class Names {
 public:
  Names(const CompiledCatalog& from, const CompiledCatalog& to, PlainRenames renames)
      : from_(from), to_(to), renames_(std::move(renames)) {}

  [[nodiscard]] std::optional<TaskId> task(TaskId id) const {
    const auto name = other_name(std::string(from_.name_of_task(id)), renames_.tasks,
                                 [&](const auto& one) { return to_.find_task(one).has_value(); });
    return name ? std::optional(to_.task_ids[to_.find_task(*name).value()]) : std::nullopt;
  }
  [[nodiscard]] std::optional<BehaviorId> behavior(BehaviorId id) const {
    const auto name =
        other_name(std::string(from_.name_of_behavior(id)), renames_.behaviors,
                   [&](const auto& one) { return to_.find_behavior(one).has_value(); });
    return name ? std::optional(to_.behavior_ids[to_.find_behavior(*name).value()]) : std::nullopt;
  }
  [[nodiscard]] std::optional<std::uint32_t> variable(std::uint32_t id) const {
    const auto name =
        other_name(std::string(from_.name_of_variable(id)), renames_.variables,
                   [&](const auto& one) { return to_.find_variable(one).has_value(); });
    return name ? to_.find_variable(*name) : std::nullopt;
  }
  [[nodiscard]] std::optional<VariableValue> value(VariableValue value) const {
    const auto known = variable(value.variable);
    if (!known) return std::nullopt;
    const auto found = to_.find_value(*known, from_.name_of_value(value));
    return found ? std::optional(VariableValue{*known, *found}) : std::nullopt;
  }

  [[nodiscard]] std::optional<Move> move(Move move) const {
    switch (move.kind) {
      case Move::Kind::due:
        return move;
      case Move::Kind::start:
      case Move::Kind::stop: {
        const auto found = task(from_.task_ids[move.subject]);
        if (!found) return std::nullopt;
        move.subject = to_.tasks[*found].catalog_index;
        return move;
      }
      case Move::Kind::together:
        return joint_move(move);
      case Move::Kind::variable: {
        const auto found = value({move.subject, static_cast<std::uint32_t>(move.choice)});
        if (!found) return std::nullopt;
        return Move{move.kind, found->variable, static_cast<std::int32_t>(found->value)};
      }
      default: {
        const auto found = behavior(from_.behavior_ids[move.subject]);
        if (!found) return std::nullopt;
        move.subject = to_.behaviors[*found].catalog_index;
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
      if (const auto found = variable(one)) result.variables.push_back(*found);
    }
    result.behaviors.clear();
    for (const BehaviorId one : from.behaviors) {
      if (const auto id = behavior(one)) result.behaviors.push_back(*id);
    }
    result.listed_for_faults.clear();
    for (const BehaviorId one : from.listed_for_faults) {
      if (const auto id = behavior(one)) result.listed_for_faults.push_back(*id);
    }
    result.never.clear();
    for (const SituationPart& entry : from.never) {
      const SituationPart translated = part(entry);
      if (translated.variables.size() == entry.variables.size() &&
          translated.behaviors.size() == entry.behaviors.size()) {
        result.never.push_back(translated);
      }
    }
    for (std::vector<std::uint32_t>& list : result.together) {
      std::vector<std::uint32_t> known;
      for (const std::uint32_t one : list) {
        if (const auto found = variable(one)) known.push_back(*found);
      }
      std::sort(known.begin(), known.end());
      list = std::move(known);
    }
    result.initially = part(from.initially);
    return result;
  }

  /// Of which `together` moves are about; before any is translated.
  void take(const Assumptions& of_from, const Assumptions& of_to) {
    of_from_ = &of_from;
    of_to_ = &of_to;
  }

  /// The variables that behaviors of these groups name.
  [[nodiscard]] std::set<std::uint32_t> variables(const std::vector<GroupId>& groups) const {
    std::set<std::uint32_t> known;
    for (const FittingValue& fitting : from_.fitting_values) {
      if (!contains(groups, from_.group_of(fitting.behavior))) continue;
      if (const auto found = variable(fitting.variable)) known.insert(*found);
    }
    return known;
  }

 private:
  [[nodiscard]] std::optional<Move> joint_move(Move move) const {
    std::vector<VariableValue> values;
    const auto of_from = combinations_of(from_, of_from_->together.at(move.subject));
    for (const VariableValue& one : of_from.at(static_cast<std::size_t>(move.choice))) {
      const auto found = value(one);
      if (!found) return std::nullopt;
      values.push_back(*found);
    }
    const auto all = combinations_of(to_, of_to_->together.at(move.subject));
    const auto place = std::find_if(all.begin(), all.end(), [&](const auto& other) {
      return std::all_of(other.begin(), other.end(),
                         [&](const VariableValue& one) { return contains(values, one); });
    });
    if (place == all.end()) return std::nullopt;
    move.choice = static_cast<std::int32_t>(place - all.begin());
    return move;
  }

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
  const PlainRenames renames_;
  const Assumptions* of_from_ = nullptr;
  const Assumptions* of_to_ = nullptr;
};

/// What happens in one of two catalogs, as far as it is about what both have, in the names of the
/// new one.
class CommonWords {
 public:
  /// `to_new`: null: it is the new catalog.
  CommonWords(const CompiledCatalog& catalog, const CompiledCatalog& new_catalog,
              const Names& to_other, const Names* to_new)
      : catalog_(catalog), new_(new_catalog), to_other_(to_other), to_new_(to_new) {}

  [[nodiscard]] bool has_both(TaskId task) const { return to_other_.task(task).has_value(); }
  /// Also of what only one of them has.
  [[nodiscard]] std::string name(TaskId task) const {
    if (!has_both(task) || to_new_ == nullptr) return std::string(catalog_.name_of_task(task));
    return std::string(new_.name_of_task(to_new_->task(task).value()));
  }
  [[nodiscard]] std::string name(BehaviorId behavior) const {
    if (!to_other_.behavior(behavior)) {
      return std::string(catalog_.name_of_behavior(behavior)) + (to_new_ ? " of old" : " of new");
    }
    if (to_new_ == nullptr) return std::string(catalog_.name_of_behavior(behavior));
    return std::string(new_.name_of_behavior(to_new_->behavior(behavior).value()));
  }
  /// The behaviors of tasks that run.
  [[nodiscard]] std::map<std::string, std::string> running(const VisibleState& state,
                                                           bool of_both) const {
    std::map<std::string, std::string> names;
    for (const auto& [task, behavior] : state.running) {
      if (has_both(task) == of_both) names[name(task)] = name(behavior);
    }
    return names;
  }
  [[nodiscard]] std::string describe(const VisibleState& state) const {
    std::string text;
    for (const auto& [task, behavior] : running(state, true)) text += task + ":" + behavior + " ";
    for (const auto& set : state.queue) text += "[" + describe(set) + "]";
    return text + " waiting" + describe(state.waiting);
  }
  /// Whether it is about what only one of them has.
  [[nodiscard]] bool is_about_else(const Happening& event) const {
    return event.verb == Verb::fault || event.verb == Verb::repair ||
           (event.task != none && !has_both(event.task)) ||
           (event.behavior != none && !is_common(event.behavior));
  }
  [[nodiscard]] std::string describe(const Happening& event) const {
    const std::string effects = describe_effects(event);
    std::string text(name_of(event.verb));
    text.append(" ").append(name_of(event.origin)).append(" ");
    if (event.task != none) text += name(event.task);
    if (event.behavior != none) text += name(event.behavior);
    return text + " " + std::string(name_of(event.outcome)) + effects + "; " +
           describe(event.after);
  }

  /// Changes and stops.
  [[nodiscard]] std::string describe_effects(const Happening& event) const {
    std::string text;
    for (const Happening::Change& change : event.changes) {
      if (!is_common(change.behavior)) continue;
      text += (change.is_activation ? " +" : " -") + name(change.behavior) +
              (change.success ? "" : "!");
    }
    std::set<std::string> stopped;
    for (const auto& [task, cause] : event.stopped) {
      if (has_both(task)) stopped.insert(name(task) + " " + std::string(name_of(cause)));
    }
    for (const std::string& one : stopped) text += "; stopped " + one;
    return text;
  }

 private:
  /// Whether both have the behavior, and one of the tasks that it performs here.
  [[nodiscard]] bool is_common(BehaviorId behavior) const {
    const auto values = catalog_.performs[behavior];
    return to_other_.behavior(behavior) &&
           std::any_of(values.begin(), values.end(),
                       [&](ValueId value) { return has_both(catalog_.task_of(value)); });
  }
  [[nodiscard]] std::string describe(const std::vector<TaskId>& tasks) const {
    std::set<std::string> sorted;
    for (const TaskId task : tasks) {
      if (has_both(task)) sorted.insert(name(task));
    }
    std::string text;
    for (const std::string& one : sorted) text += " " + one;
    return text;
  }

  const CompiledCatalog& catalog_;
  const CompiledCatalog& new_;
  const Names& to_other_;
  const Names* const to_new_;
};

/// A catalog in which the tasks that another one does not have start on request at most.
struct QuietCatalog {
  QuietCatalog(const CompiledCatalog& from, const Names& to_other)
      : tasks(from.tasks.begin(), from.tasks.end()), catalog(from) {
    for (TaskId task(0); task < tasks.size(); ++task) {
      if (!to_other.task(task)) tasks[task].reactive_start = 0;
    }
    catalog.tasks = tasks;
  }
  QuietCatalog(const QuietCatalog&) = delete;
  QuietCatalog& operator=(const QuietCatalog&) = delete;

  std::vector<CompiledTask> tasks;
  CompiledCatalog catalog;
};

struct Groups {
  std::vector<GroupId> of_old;
  std::vector<GroupId> of_new;
};

/// Puts groups together that have a name in common, until no two are left that have.
std::vector<Groups> join_groups(const CompiledCatalog& old_catalog,
                                const CompiledCatalog& new_catalog, const CommonWords& old_words,
                                const CommonWords& new_words) {
  struct Named {
    Groups groups;
    std::set<std::string> names;
  };
  std::vector<Named> all;
  const auto add = [&](const CompiledCatalog& catalog, const CommonWords& words, bool is_new) {
    const std::string side = is_new ? " of new" : " of old";
    for (GroupId group(0); group < catalog.group_count(); ++group) {
      Named& one = all.emplace_back();
      (is_new ? one.groups.of_new : one.groups.of_old).push_back(group);
      for (const TaskId task : catalog.task_ids) {
        if (catalog.tasks[task].group != group) continue;
        one.names.insert("task " + words.name(task) + (words.has_both(task) ? "" : side));
      }
      for (const BehaviorId behavior : catalog.behavior_ids) {
        if (catalog.group_of(behavior) != group) continue;
        one.names.insert("behavior " + words.name(behavior));
      }
    }
  };
  add(new_catalog, new_words, true);
  add(old_catalog, old_words, false);
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
             const Assumptions& new_assumptions, const Names& to_old, const Names& to_new,
             const CommonWords& old_words, const CommonWords& new_words, const PlainScope& scope)
      : scope_(scope),
        to_old_(to_old),
        to_new_(to_new),
        old_words_(old_words),
        new_words_(new_words),
        old_(old_catalog, groups.of_old, old_assumptions, to_old.variables(groups.of_new)),
        new_(new_catalog, groups.of_new, new_assumptions, to_new.variables(groups.of_old)) {}

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

  /// What both have.
  [[nodiscard]] std::vector<std::string> observe(const PlainModel& model, const CommonWords& words,
                                                 const Move& move,
                                                 const std::vector<Happening>& happenings,
                                                 const VisibleState& end) const {
    std::vector<std::string> lines;
    if (scope_.differences == PlainDifferences::expectable) {
      if (move.kind <= Move::Kind::situation_change) {
        lines.emplace_back(name_of(happenings.front().outcome));
      }
      VisibleState running = end;
      running.queue.clear();
      running.waiting.clear();
      lines.push_back(named(model.catalog(), running));
      return lines;
    }
    // What events about something else do to what both have, between two events of both.
    Happening skipped;
    const auto add_skipped = [&] {
      const std::string effects = words.describe_effects(std::exchange(skipped, {}));
      if (!effects.empty()) lines.push_back("something else" + effects);
    };
    for (const Happening& one : happenings) {
      if (words.is_about_else(one)) {
        skipped.changes.insert(skipped.changes.end(), one.changes.begin(), one.changes.end());
        skipped.stopped.insert(skipped.stopped.end(), one.stopped.begin(), one.stopped.end());
        continue;
      }
      add_skipped();
      lines.push_back(words.describe(one));
    }
    add_skipped();
    lines.push_back(words.describe(end));
    return lines;
  }

  [[nodiscard]] static bool has_decision(const CommonWords& words,
                                         const std::vector<Happening>& happenings) {
    return std::any_of(happenings.begin(), happenings.end(), [&](const Happening& one) {
      return form_of(one.verb).is_decided && !words.is_about_else(one);
    });
  }

  /// True if a move differs, and that ends the search.
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
      const VisibleState new_end = new_.visible(next.of_new);
      const VisibleState old_end = old_.visible(next.of_old);
      // The events before the first that is not the same in both came in both, and so did that.
      if (has_decision(new_words_, of_new) && has_decision(old_words_, of_old)) {
        result.is_compared = true;
      }
      const bool is_alike = observe(new_, new_words_, move, of_new, new_end) ==
                            observe(old_, old_words_, move, of_old, old_end);
      bool differs = !is_alike;
      for (const bool of_both : {true, false}) {
        if (!of_both && scope_.allow_missing) continue;
        if (note_running(place, move, new_words_.running(new_end, of_both),
                         old_words_.running(old_end, of_both), result)) {
          differs = true;
        }
      }
      if (differs) note_difference(place, move, result);
      if (differs && scope_.differences == PlainDifferences::expectable) return true;
      if (is_alike) add(std::move(next));
    }
    return false;
  }

  /// False: there is no difference.
  bool note_running(std::size_t place, const Move& move,
                    const std::map<std::string, std::string>& of_new,
                    const std::map<std::string, std::string>& of_old, PlainComparison& result) {
    std::set<std::string> differing;
    for (const auto& entry : of_new) {
      const auto other = of_old.find(entry.first);
      if (other == of_old.end() || other->second != entry.second) differing.insert(entry.first);
    }
    for (const auto& entry : of_old) {
      if (!of_new.contains(entry.first)) differing.insert(entry.first);
    }
    for (const std::string& task : differing) result.running.emplace(task, path_of(place, move));
    return !differing.empty();
  }

  [[nodiscard]] std::vector<Move> path_of(std::size_t place, const Move& last) const {
    std::vector<Move> moves{last};
    for (std::size_t at = place; at != 0; at = nodes_[at].parent) moves.push_back(nodes_[at].move);
    std::reverse(moves.begin(), moves.end());
    return moves;
  }

  void note_difference(std::size_t place, const Move& move, PlainComparison& result) const {
    std::vector<Move> moves = path_of(place, move);
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

  const PlainScope& scope_;
  const Names& to_old_;
  const Names& to_new_;
  const CommonWords& old_words_;
  const CommonWords& new_words_;
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
                                std::uint64_t max_states, const PlainScope& scope) {
  PlainComparison result;
  result.is_complete = true;
  Names to_new(old_catalog, new_catalog, scope.renames);
  Names to_old(new_catalog, old_catalog,
               {inverse(scope.renames.tasks), inverse(scope.renames.behaviors),
                inverse(scope.renames.variables)});
  const CommonWords old_words(old_catalog, new_catalog, to_new, &to_new);
  const CommonWords new_words(new_catalog, new_catalog, to_old, nullptr);
  const QuietCatalog quiet_old(old_catalog, to_new);
  const QuietCatalog quiet_new(new_catalog, to_old);
  const Assumptions of_old = to_old.assumptions(assumptions);
  const Assumptions of_new = to_new.assumptions(of_old);
  to_new.take(of_old, of_new);
  to_old.take(of_new, of_old);
  for (const Groups& groups : join_groups(old_catalog, new_catalog, old_words, new_words)) {
    PairSearch search(quiet_old.catalog, quiet_new.catalog, groups, of_old, of_new, to_old, to_new,
                      old_words, new_words, scope);
    if (!search.run(max_states, result)) result.is_complete = false;
    if (result.has_error) return result;
  }
  return result;
}

}  // namespace cbc::plain
