#include "runtime/solver/domains.h"

#include <algorithm>
#include <bit>

namespace cbc {
namespace {

/// Most changes are of one bit, and std::popcount may be the call of a function.
std::uint32_t count_bits(std::uint64_t word) {
  return (word & (word - 1)) == 0 ? 1 : static_cast<std::uint32_t>(std::popcount(word));
}

}  // namespace

Domains::Domains(const CompiledCatalog& catalog)
    : Domains(catalog, most_in_a_group(catalog.group_tasks), most_values_in_a_group(catalog)) {}

Domains::Domains(const CompiledCatalog& catalog, GroupId group)
    : Domains(catalog, catalog.group_tasks[group + 1] - catalog.group_tasks[group],
              catalog.values.begin[catalog.group_tasks[group + 1]] -
                  catalog.values.begin[catalog.group_tasks[group]]) {}

Domains::Domains(const CompiledCatalog& catalog, std::size_t most_tasks, std::size_t most_values)
    : catalog_(catalog), most_variables_(most_tasks + most_values) {
  tasks_.resize(most_tasks);
  words_.resize(most_tasks + most_values / 64);  // a word is full, or the last of its task
  needed_.reserve(most_tasks);
  changed_.reserve(most_tasks);
  trail_.reserve(most_variables_);  // each value, and each "not running", leaves once
}

void Domains::load(GroupId group, std::span<const std::uint64_t> words) {
  first_task_ = catalog_.group_tasks[group];
  first_behavior_ = catalog_.group_behaviors[group];
  task_count_ = catalog_.group_tasks[group + 1] - first_task_;
  std::copy(words.begin(), words.end(), words_.begin());
  needed_.clear();
  trail_.clear();
  changed_.clear();
  sums_ = {};

  const std::uint32_t first_word = catalog_.words[first_task_];
  for (LocalTask task(0); task < task_count_; ++task) {
    const TaskId id = first_task_ + task;
    TaskState& state = tasks_[task];
    state.values = catalog_.values.items.data() + catalog_.values.begin[id];
    state.value_count = catalog_.values.begin[id + 1] - catalog_.values.begin[id];
    state.word = catalog_.words[id] - first_word;
    state.word_count = catalog_.words[id + 1] - catalog_.words[id];
    state.start_on_request = catalog_.tasks[id].start_on_request;
    state.is_changed = false;
    state.may_stop = true;
    state.count = 0;
    for (std::uint32_t word = 0; word < state.word_count; ++word) {
      state.count += static_cast<std::uint32_t>(std::popcount(words_[state.word + word]));
    }
    find_best(state);
    if (state.count == 0) note_change(task);
  }
}

bool Domains::all_within(LocalTask task, const std::uint64_t* mask) const {
  const TaskState& state = tasks_[task];
  for (std::uint32_t word = 0; word < state.word_count; ++word) {
    if ((words_[state.word + word] & ~mask[word]) != 0) return false;
  }
  return true;
}

bool Domains::any_within(LocalTask task, const std::uint64_t* mask) const {
  const TaskState& state = tasks_[task];
  for (std::uint32_t word = 0; word < state.word_count; ++word) {
    if ((words_[state.word + word] & mask[word]) != 0) return true;
  }
  return false;
}

bool Domains::need(LocalTask task) {
  TaskState& state = tasks_[task];
  if (!state.may_stop) return true;
  if (state.count == 0) return false;
  state.may_stop = false;
  trail_.push_back({task, none, 0});
  needed_.push_back(task);
  add_share(state.values[state.best], 1);
  if (!state.start_on_request) ++sums_.idle;
  note_change(task);
  return true;
}

bool Domains::close(LocalTask task) {
  if (!tasks_[task].may_stop) return false;
  const TaskState& state = tasks_[task];
  for (std::uint32_t word = state.word; word < state.word + state.word_count; ++word) {
    if (!narrow(task, word, 0)) return false;
  }
  return true;
}

bool Domains::remove(LocalTask task, std::uint32_t index) {
  const std::uint32_t word = tasks_[task].word + index / 64;
  return narrow(task, word, words_[word] & ~(std::uint64_t{1} << (index % 64)));
}

bool Domains::remove_all(LocalTask task, const std::uint64_t* mask) {
  const TaskState& state = tasks_[task];
  for (std::uint32_t word = 0; word < state.word_count; ++word) {
    if (!narrow(task, state.word + word, words_[state.word + word] & ~mask[word])) return false;
  }
  return true;
}

bool Domains::keep_only(LocalTask task, std::uint32_t index) {
  const TaskState& state = tasks_[task];
  const std::uint32_t kept = state.word + index / 64;
  for (std::uint32_t word = state.word; word < state.word + state.word_count; ++word) {
    const std::uint64_t bit = word == kept ? std::uint64_t{1} << (index % 64) : 0;
    // The kept word comes last, so that no step on the way leaves the domain empty.
    if (word != kept && !narrow(task, word, 0)) return false;
    if (word == kept && !narrow(task, word, words_[word] & bit)) return false;
  }
  return true;
}

bool Domains::narrow(LocalTask task, std::uint32_t word, std::uint64_t after) {
  const std::uint64_t before = words_[word];
  if (before == after) return true;
  TaskState& state = tasks_[task];
  trail_.push_back({task, word, before});
  words_[word] = after;
  state.count -= count_bits(before ^ after);
  if (state.count == 0) {
    note_change(task);
    return state.may_stop;
  }
  const std::uint32_t best = state.best;
  if (!has(task, best)) {
    find_best(state);
    if (!state.may_stop) {
      add_share(state.values[best], -1);
      add_share(state.values[state.best], 1);
    }
  }
  if (!state.may_stop) note_change(task);
  return true;
}

void Domains::undo_to(const Mark& mark) {
  while (trail_.size() > mark.trail) {
    const Change& change = trail_.back();
    TaskState& state = tasks_[change.task];
    if (change.word == none) {
      state.may_stop = true;
    } else {
      const std::uint32_t first = 64 * (change.word - state.word) +
                                  static_cast<std::uint32_t>(std::countr_zero(change.before));
      if (state.count == 0 || first < state.best) state.best = first;
      state.count += count_bits(words_[change.word] ^ change.before);
      words_[change.word] = change.before;
    }
    trail_.pop_back();
  }
  needed_.resize(mark.needed);
  sums_ = mark.sums;
  forget_changes();
}

LocalTask Domains::next_changed() {
  const LocalTask task = changed_.back();
  changed_.pop_back();
  tasks_[task].is_changed = false;
  return task;
}

void Domains::forget_changes() {
  for (const LocalTask task : changed_) tasks_[task].is_changed = false;
  changed_.clear();
}

/// The share of a value, or, -1 times, what it has been.
void Domains::add_share(const Value& best, std::int32_t times) {
  sums_.cost += times * best.cost;
  if (best.suitability == 0) {
    sums_.zeros += static_cast<std::uint32_t>(times);
  } else if (best.suitability != one_million) {
    sums_.factors += static_cast<std::uint32_t>(times);
  }
}

void Domains::find_best(TaskState& state) const {
  for (std::uint32_t word = 0; word < state.word_count; ++word) {
    const std::uint64_t bits = words_[state.word + word];
    if (bits == 0) continue;
    state.best = word * 64 + static_cast<std::uint32_t>(std::countr_zero(bits));
    return;
  }
}

void Domains::note_change(LocalTask task) {
  TaskState& state = tasks_[task];
  if (state.is_changed) return;
  state.is_changed = true;
  changed_.push_back(task);
}

}  // namespace cbc
