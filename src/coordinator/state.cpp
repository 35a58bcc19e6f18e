#include "coordinator/state.h"

#include <algorithm>
#include <bit>

namespace cbc {

State::State(const CompiledCatalog& catalog)
    : catalog_(catalog),
      places_(catalog.tasks.size(), none),
      taken_at_(catalog.tasks.size(), 0),
      has_request_(catalog.tasks.size(), 0),
      requests_(catalog.tasks.size()),
      running_((catalog.tasks.size() + 63) / 64, 0),
      available_(catalog.behaviors.size(), 1),
      available_words_(catalog.words.back(), 0),
      faulty_(catalog.behaviors.size(), 0),
      active_(catalog.behaviors.size(), 0),
      activated_at_(catalog.behaviors.size(), 0),
      timeouts_(catalog.tasks.size()),
      queue_(catalog.tasks.size()) {
  for (const CompiledTask& task : catalog.tasks) {
    if (!task.start_on_request) ++idle_total_;
  }
  for (BehaviorId behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    set_available(behavior, true);
  }
}

void State::set_place(TaskId task, std::uint32_t place, Microseconds now) {
  if (places_[task] == place) return;
  const bool was_running = is_running(task);
  places_[task] = place;
  taken_at_[task] = now;
  if (was_running == is_running(task)) return;

  const CompiledTask& compiled = catalog_.tasks[task];
  running_[compiled.catalog_index / 64] ^= std::uint64_t{1} << (compiled.catalog_index % 64);
  if (was_running) {
    if (!compiled.start_on_request) --idle_running_;
    if (has_request(task)) --request_count_;
    has_request_[task] = 0;
  } else {
    if (!compiled.start_on_request) ++idle_running_;
  }
}

std::vector<std::uint32_t> State::running() const {
  std::size_t count = 0;
  for (const std::uint64_t word : running_) count += static_cast<std::size_t>(std::popcount(word));
  std::vector<std::uint32_t> tasks;
  tasks.reserve(count);
  for (std::uint32_t word = 0; word < running_.size(); ++word) {
    for (std::uint64_t bits = running_[word]; bits != 0; bits &= bits - 1) {
      tasks.push_back(word * 64 + static_cast<std::uint32_t>(std::countr_zero(bits)));
    }
  }
  return tasks;
}

void State::set_request(TaskId task, std::int32_t priority, std::uint64_t event,
                        std::string_view parameters) {
  if (!has_request(task)) ++request_count_;
  has_request_[task] = 1;
  requests_[task].priority = priority;
  requests_[task].event = event;
  requests_[task].parameters = parameters;
}

void State::set_available(BehaviorId behavior, bool available) {
  available_[behavior] = available ? 1 : 0;
  for (const ValueId value : catalog_.performs[behavior]) {
    const TaskId task = catalog_.task_of(value);
    const std::uint32_t place = value - catalog_.values.begin[task];
    const std::uint64_t bit = std::uint64_t{1} << (place % 64);
    std::uint64_t& word = available_words_[catalog_.words[task] + place / 64];
    word = available ? word | bit : word & ~bit;
  }
}

bool State::has_available_behavior(TaskId task) const {
  const auto first = available_words_.begin() + catalog_.words[task];
  const auto end = available_words_.begin() + catalog_.words[task + 1];
  return std::any_of(first, end, [](std::uint64_t word) { return word != 0; });
}

void State::set_active(BehaviorId behavior, Microseconds now) {
  active_[behavior] = 1;
  activated_at_[behavior] = now;
}

void State::update_timeout(TaskId task, Microseconds now) {
  const CompiledTask& compiled = catalog_.tasks[task];
  Microseconds timeout = 0;
  if (is_running(task) && !compiled.keep_running) {
    const Microseconds own = catalog_.behaviors[behavior(task)].timeout;
    timeout = own > 0 ? own : compiled.timeout;
  }
  if (timeout == 0) {
    timeouts_.remove(compiled.catalog_index);
    return;
  }
  const Microseconds due = std::max(activated_at_[behavior(task)], taken_at_[task]) + timeout;
  // What is not waited for any more and was due by now has been dealt with.
  if (due > now || timeouts_.has(compiled.catalog_index)) {
    timeouts_.set(compiled.catalog_index, due);
  }
}

void State::enqueue(TaskId task, Microseconds due) {
  const std::uint32_t item = catalog_.tasks[task].catalog_index;
  if (!is_running(task) && !queue_.has(item)) queue_.set(item, due);
}

bool State::excludes_running_task(TaskId task) const {
  for (const std::uint32_t clique : catalog_.task_cliques[task]) {
    for (const TaskId other : catalog_.cliques[clique]) {
      if (other != task && is_running(other)) return true;
    }
  }
  return false;
}

}  // namespace cbc
