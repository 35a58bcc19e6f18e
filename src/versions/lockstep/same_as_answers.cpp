#include "versions/lockstep/same_as_answers.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "runtime/base/text.h"
#include "runtime/coordinator/record.h"

namespace cbc {

void AnswerComparison::compare(const MoveTrace& of_new, const MoveTrace& of_old,
                               const std::uint16_t* new_cells, const std::uint16_t* old_cells) {
  notes_.clear();
  is_alike_ = true;
  is_compared_ = false;
  compare_events(of_new.events, of_old.events);
  compare_running(new_cells, old_cells);
  if (differences_ == Differences::expectable) return;
  const auto part = [](const Model& model, const std::uint16_t* cells, std::uint32_t begin) {
    return Part(cells + begin, model.layout().reactive_count);
  };
  const Model::Layout& ours = models_.new_model.layout();
  const Model::Layout& theirs = models_.old_model.layout();
  compare_queues(part(models_.new_model, new_cells, ours.queue),
                 part(models_.old_model, old_cells, theirs.queue),
                 part(models_.new_model, new_cells, ours.waiting),
                 part(models_.old_model, old_cells, theirs.waiting));
}

// Notes.

template <typename ToLine>
void AnswerComparison::note(std::uint32_t task, Aspect aspect, const ToLine& to_line) {
  if (ModelPair::is_in_both(models_.tasks[task])) {
    is_alike_ = false;
  } else if (allow_missing_) {
    return;
  }
  Note& added = notes_.emplace_back();
  added.task = task;
  added.aspect = aspect;
  if (with_lines_) added.line = to_line();
}

template <typename ToLine>
void AnswerComparison::note_behavior(std::uint32_t behavior, bool is_new, Aspect aspect,
                                     const ToLine& to_line) {
  const Model& in = model(is_new);
  const auto& pairs = is_new ? models_.pair_of_new : models_.pair_of_old;
  for (const std::uint32_t value : in.behaviors()[behavior].values) {
    const std::uint32_t task = pairs[in.task_of(value)];
    note(task, aspect, [&] { return fmt::format("{}: {}", label_of(task), to_line()); });
  }
}

template <typename ToLine>
void AnswerComparison::note_event(const Happening& event, bool is_new, Aspect aspect,
                                  const ToLine& to_line) {
  if (event.verb == Verb::finish) return note_behavior(event.subject, is_new, aspect, to_line);
  const std::uint32_t task = (is_new ? models_.pair_of_new : models_.pair_of_old)[event.subject];
  note(task, aspect, [&] { return fmt::format("{}: {}", label_of(task), to_line()); });
}

// Events.

void AnswerComparison::compare_events(const std::vector<Happening>& ours,
                                      const std::vector<Happening>& theirs) {
  std::size_t our_place = 0;
  std::size_t their_place = 0;
  // Events about something else do not count, but what they do to what both have does: all of those
  // between two events of both together.
  const auto skip = [&](const std::vector<Happening>& events, bool is_new, std::size_t& place,
                        Happening& together) {
    together.changes.clear();
    together.stopped.clear();
    for (; place < events.size() && !is_in_both(events[place], is_new); ++place) {
      const Happening& skipped = events[place];
      together.changes.insert(together.changes.end(), skipped.changes.begin(),
                              skipped.changes.end());
      together.stopped.insert(together.stopped.end(), skipped.stopped.begin(),
                              skipped.stopped.end());
    }
    return place < events.size();
  };
  for (;; ++our_place, ++their_place) {
    const bool has_ours = skip(ours, true, our_place, our_skipped_);
    const bool has_theirs = skip(theirs, false, their_place, their_skipped_);
    if (differences_ == Differences::all) {
      compare_changes(our_skipped_, their_skipped_);
      compare_stops(our_skipped_, their_skipped_);
    }
    if (!has_ours && !has_theirs) return;
    if (has_ours && has_theirs && is_same_event(ours[our_place], theirs[their_place])) {
      compare_answers(ours[our_place], theirs[their_place]);
      // Expectations know the outcome of the event of the script, and no other.
      if (differences_ == Differences::expectable) return;
      continue;
    }
    if (differences_ == Differences::expectable) return;
    const bool is_ours_alone = has_ours && note_lone_event(ours[our_place], true, theirs);
    const bool is_theirs_alone = has_theirs && note_lone_event(theirs[their_place], false, ours);
    if (is_ours_alone || is_theirs_alone) return;
    // Both come in both.
    const bool is_new = has_ours;
    const Happening& first = is_new ? ours[our_place] : theirs[their_place];
    note_event(first, is_new, Aspect::event, [&] {
      return fmt::format("{} comes earlier in {}", describe(first, is_new), file(is_new));
    });
    return;
  }
}

bool AnswerComparison::is_in_both(const Happening& event, bool is_new) const {
  if (event.verb == Verb::situation) return true;
  // What it does is compared with what the other one does until the next event of both.
  if (event.verb == Verb::reconsider) return false;
  if (event.verb == Verb::finish) {
    return models_.is_compared(event.subject, is_new);
  }
  const auto& pairs = is_new ? models_.pair_of_new : models_.pair_of_old;
  return ModelPair::is_in_both(models_.tasks[pairs[event.subject]]);
}

bool AnswerComparison::is_same_event(const Happening& ours, const Happening& theirs) const {
  if (ours.verb != theirs.verb || ours.origin != theirs.origin) return false;
  if (ours.verb == Verb::situation) return true;
  return ours.verb == Verb::finish ? models_.is_same_behavior(ours.subject, theirs.subject)
                                   : models_.is_same_task(ours.subject, theirs.subject);
}

void AnswerComparison::compare_answers(const Happening& ours, const Happening& theirs) {
  if (form_of(ours.verb).is_decided) {
    is_compared_ = true;
    const bool counts = differences_ == Differences::all || ours.origin == Origin::script;
    if (counts && ours.outcome != theirs.outcome) {
      note_event(ours, true, Aspect::outcome, [&] {
        return fmt::format("{} {} in {}, {} in {}", describe(ours, true),
                           cbc::name_of(theirs.outcome), file(false), cbc::name_of(ours.outcome),
                           file(true));
      });
    }
  }
  if (differences_ == Differences::expectable) return;
  compare_changes(ours, theirs);
  compare_stops(ours, theirs);
  compare_suspended(ours, theirs);
  compare_queues(ours.queue, theirs.queue, ours.waiting, theirs.waiting);
}

/// False: it is one of the events of the other catalog, too.
bool AnswerComparison::note_lone_event(const Happening& event, bool is_new,
                                       const std::vector<Happening>& others) {
  const auto is_same = [&](const Happening& other) {
    return is_new ? is_same_event(event, other) : is_same_event(other, event);
  };
  if (std::any_of(others.begin(), others.end(), is_same)) return false;
  note_event(event, is_new, Aspect::event,
             [&] { return fmt::format("{} in {} only", describe(event, is_new), file(is_new)); });
  return true;
}

bool AnswerComparison::is_same_change(const MoveTrace::Change& ours,
                                      const MoveTrace::Change& theirs) const {
  return ours.is_activation == theirs.is_activation && ours.success == theirs.success &&
         models_.is_same_behavior(ours.behavior, theirs.behavior);
}

void AnswerComparison::compare_changes(const Happening& ours, const Happening& theirs) {
  std::size_t our_place = 0;
  std::size_t their_place = 0;
  const auto skip = [&](const std::vector<MoveTrace::Change>& changes, bool is_new,
                        std::size_t& place) {
    while (place < changes.size() && !models_.is_compared(changes[place].behavior, is_new)) ++place;
    return place < changes.size();
  };
  for (;; ++our_place, ++their_place) {
    const bool has_ours = skip(ours.changes, true, our_place);
    const bool has_theirs = skip(theirs.changes, false, their_place);
    if (!has_ours && !has_theirs) return;
    if (!has_ours || !has_theirs ||
        !is_same_change(ours.changes[our_place], theirs.changes[their_place])) {
      break;
    }
  }
  const bool is_ours_alone = note_lone_changes(ours, true, theirs);
  const bool is_theirs_alone = note_lone_changes(theirs, false, ours);
  if (is_ours_alone || is_theirs_alone) return;
  const bool is_new = our_place < ours.changes.size();
  const std::uint32_t behavior =
      is_new ? ours.changes[our_place].behavior : theirs.changes[their_place].behavior;
  note_behavior(behavior, is_new, Aspect::change, [&] {
    return fmt::format("{} changes in another order", behavior_name(behavior, is_new));
  });
}

/// The changes that the other catalog does not make in the same event. False: there is none.
bool AnswerComparison::note_lone_changes(const Happening& event, bool is_new,
                                         const Happening& other) {
  bool is_any = false;
  for (const MoveTrace::Change& change : event.changes) {
    if (!models_.is_compared(change.behavior, is_new)) continue;
    const auto is_same = [&](const MoveTrace::Change& candidate) {
      return is_new ? is_same_change(change, candidate) : is_same_change(candidate, change);
    };
    if (std::any_of(other.changes.begin(), other.changes.end(), is_same)) continue;
    is_any = true;
    const char* const what = !change.is_activation ? "is deactivated"
                             : change.success      ? "is activated"
                                                   : "fails to become active";
    note_behavior(change.behavior, is_new, Aspect::change, [&] {
      return fmt::format("{} {} in {} only", behavior_name(change.behavior, is_new), what,
                         file(is_new));
    });
  }
  return is_any;
}

void AnswerComparison::compare_stops(const Happening& ours, const Happening& theirs) {
  const auto find = [](const Happening& event, std::uint32_t task) {
    return std::find_if(event.stopped.begin(), event.stopped.end(),
                        [&](const auto& stop) { return stop.first == task; });
  };
  for (const auto& [task, cause] : ours.stopped) {
    const std::uint32_t pair = models_.pair_of_new[task];
    if (!ModelPair::is_in_both(models_.tasks[pair])) continue;
    const auto other = find(theirs, models_.tasks[pair].second);
    if (other == theirs.stopped.end()) {
      note(pair, Aspect::stop,
           [&] { return fmt::format("{} stops in {} only", label_of(pair), file(true)); });
    } else if (other->second != cause) {
      note(pair, Aspect::stop, [&, our_cause = cause] {
        return fmt::format("{}: stopped by {} in {}, by {} in {}", label_of(pair),
                           cbc::name_of(other->second), file(false), cbc::name_of(our_cause),
                           file(true));
      });
    }
  }
  for (const auto& stop : theirs.stopped) {
    const std::uint32_t pair = models_.pair_of_old[stop.first];
    if (!ModelPair::is_in_both(models_.tasks[pair])) continue;
    if (find(ours, models_.tasks[pair].first) != ours.stopped.end()) continue;
    note(pair, Aspect::stop,
         [&] { return fmt::format("{} stops in {} only", label_of(pair), file(false)); });
  }
}

void AnswerComparison::compare_suspended(const Happening& ours, const Happening& theirs) {
  const auto priority_in = [](const Model& model, const Happening& event, std::uint32_t task) {
    const auto found = std::find_if(event.suspended.begin(), event.suspended.end(),
                                    [task](const auto& one) { return one.first == task; });
    return found == event.suspended.end() ? 0 : model.priority_of(found->second);
  };
  if (ours.suspended.empty() && theirs.suspended.empty()) return;
  for (std::uint32_t pair = 0; pair < models_.tasks.size(); ++pair) {
    const auto [of_new, of_old] = models_.tasks[pair];
    const std::int32_t our_priority = priority_in(models_.new_model, ours, of_new);
    const std::int32_t their_priority = priority_in(models_.old_model, theirs, of_old);
    if (our_priority == their_priority) continue;
    note(pair, Aspect::suspended, [&, pair = pair] {
      if (our_priority != 0 && their_priority != 0) {
        return fmt::format("{}: the suspended request has priority {} in {}, {} in {}",
                           label_of(pair), their_priority, file(false), our_priority, file(true));
      }
      return fmt::format("the request of {} is suspended in {} only", label_of(pair),
                         file(our_priority != 0));
    });
  }
}

// States.

void AnswerComparison::compare_running(const std::uint16_t* new_cells,
                                       const std::uint16_t* old_cells) {
  const auto behavior_in = [](const Model& model, const std::uint16_t* cells, std::uint32_t task) {
    return task == none || cells[task] == 0
               ? none
               : model.behavior_of(model.tasks()[task].values.begin + cells[task] - 1U);
  };
  for (std::uint32_t pair = 0; pair < models_.tasks.size(); ++pair) {
    const auto [of_new, of_old] = models_.tasks[pair];
    const std::uint32_t ours = behavior_in(models_.new_model, new_cells, of_new);
    const std::uint32_t theirs = behavior_in(models_.old_model, old_cells, of_old);
    if (ours == none && theirs == none) continue;
    if (ours == none || theirs == none) {
      note(pair, Aspect::running,
           [&] { return fmt::format("{} runs in {} only", label_of(pair), file(theirs == none)); });
    } else if (!models_.is_same_behavior(ours, theirs)) {
      note(pair, Aspect::running, [&] {
        return fmt::format("{}: {} in place of {}", label_of(pair), behavior_name(ours, true),
                           behavior_name(theirs, false));
      });
    }
  }
}

/// The same reactive tasks are to be in the queue, in the same order, and the same ones to wait.
void AnswerComparison::compare_queues(Part new_queue, Part old_queue, Part new_waiting,
                                      Part old_waiting) {
  const auto entry = [](Part part, std::uint32_t reactive) {
    return reactive == none ? std::uint16_t{0} : part[reactive];
  };
  // Sets that correspond have the same order, but not always the same numbers.
  const auto rank = [](Part queue, std::uint16_t set) {
    std::set<std::uint16_t> before;
    std::copy_if(queue.begin(), queue.end(), std::inserter(before, before.end()),
                 [&](std::uint16_t other) { return other < set && other != 0; });
    return before.size();
  };
  for (std::uint32_t pair = 0; pair < models_.tasks.size(); ++pair) {
    const auto [ours, theirs] = models_.reactive_of(models_.tasks[pair]);
    if (ours == none && theirs == none) continue;
    const std::uint16_t our_set = entry(new_queue, ours);
    const std::uint16_t their_set = entry(old_queue, theirs);
    const bool our_wait = entry(new_waiting, ours) != 0;
    const bool their_wait = entry(old_waiting, theirs) != 0;
    if ((our_set != 0) != (their_set != 0)) {
      note(pair, Aspect::queue, [&] {
        return fmt::format("{} is about to start in {} only", label_of(pair), file(our_set != 0));
      });
    } else if (our_wait != their_wait) {
      note(pair, Aspect::queue, [&] {
        return fmt::format("{} waits to start in {} only", label_of(pair), file(our_wait));
      });
    } else if (our_set != their_set && rank(new_queue, our_set) != rank(old_queue, their_set)) {
      note(pair, Aspect::queue,
           [&] { return fmt::format("{} is about to start in another order", label_of(pair)); });
    }
  }
}

// Words.

std::string AnswerComparison::file(bool is_new) const {
  return printable(model(is_new).catalog().file);
}

std::string AnswerComparison::behavior_name(std::uint32_t behavior, bool is_new) const {
  const Model& in = model(is_new);
  return printable(in.catalog().name_of_behavior(in.behaviors()[behavior].id));
}

std::string AnswerComparison::name_of(std::uint32_t task) const {
  const auto [of_new, of_old] = models_.tasks[task];
  const Model& in = model(of_new != none);
  return std::string(in.catalog().name_of_task(in.tasks()[of_new != none ? of_new : of_old].id));
}

/// The name, and the old one if it is another.
std::string AnswerComparison::label_of(std::uint32_t task) const {
  std::string name = printable(name_of(task));
  if (!ModelPair::is_in_both(models_.tasks[task])) return name;
  const TaskId of_old = models_.old_model.tasks()[models_.tasks[task].second].id;
  const std::string old_name = printable(models_.old_model.catalog().name_of_task(of_old));
  return old_name == name ? name : fmt::format("{} (was {})", name, old_name);
}

/// "start", "reactive start", "finish of GPS"
std::string AnswerComparison::describe(const Happening& event, bool is_new) const {
  std::string text = event.origin == Origin::reactive ? "reactive " : "";
  text += cbc::name_of(event.verb);
  if (event.verb == Verb::finish) text += " of " + behavior_name(event.subject, is_new);
  return text;
}

}  // namespace cbc
