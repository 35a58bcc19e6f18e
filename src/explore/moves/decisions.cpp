#include "explore/moves/decisions.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace cbc {

namespace {

constexpr std::uint64_t number_bits = 32;
constexpr std::uint64_t number_mask = (std::uint64_t{1} << number_bits) - 1;
constexpr std::size_t requests_in_word = 4;
/// What a key has before the requests: how they count, and how many there are of which kind.
constexpr std::size_t before_requests = 3;

}  // namespace

Decisions::Decisions(const Model& model, const CompiledCatalog& catalog, std::size_t most_bytes,
                     DecisionListener listener)
    : model_(model),
      most_bytes_(most_bytes),
      listener_(std::move(listener)),
      solver_(catalog, SearchOptions{}),
      asked_(catalog),
      value_words_(words_for(model.value_count())),
      task_words_(words_for(model.tasks().size())),
      key_words_(1 + 2 * value_words_ + task_words_ +
                 (model.layout().request_count + 1 + before_requests + requests_in_word - 1) /
                     requests_in_word),
      entry_words_(key_words_ + 1 + value_words_),
      key_(key_words_),
      slots_(1024, 0) {}

const Word* Decisions::find(const GroupQuestion& question) {
  const auto answer_of = [&](const Word* entry) {
    const Word* const memory = entry + key_words_;
    return *memory == infeasible ? nullptr : memory + 1;
  };
  std::size_t slot = 0;
  write_key(question, false);
  const Word* known = look_up(hash(), slot);
  const bool is_new = known == nullptr;
  if (known != nullptr && known[key_words_] == ordered) {
    write_key(question, true);
    known = look_up(hash(), slot);
  }
  if (known != nullptr) {
    ++remembered_;
    return answer_of(known);
  }
  ++computed_;
  load_problem(question);
  bool is_solved = has_solution(solver_.solve(problem_, solution_).status);
  if (listener_) listener_(problem_, is_solved ? &solution_ : nullptr);
  if (is_solved && question.must_not_make_worse) {
    // The best solution of more choices has the best product, too, so where it is worse, it is with
    // fewer.
    const TaskId first = model_.catalog().group_tasks[problem_.group];
    is_solved = !asked_.is_worse(first, problem_, solution_);
  }
  if (is_new) {
    if (!is_solved) return answer_of(remember(infeasible));
    if (satisfies_all(question)) return answer_of(remember(solved));
    remember(ordered);
    write_key(question, true);
  }
  return answer_of(remember(is_solved ? solved : infeasible));
}

bool Decisions::satisfies_all(const GroupQuestion& question) const {
  const std::uint32_t first = model_.groups()[question.group].tasks.begin;
  return std::all_of(question.requests.begin(), question.requests.end(),
                     [&](std::uint16_t task) { return solution_[task - first] != none; });
}

const Word* Decisions::look_up(std::uint64_t hash, std::size_t& slot) const {
  const std::uint64_t tag = hash & ~number_mask;
  for (slot = hash & (slots_.size() - 1); slots_[slot] != 0;
       slot = (slot + 1) & (slots_.size() - 1)) {
    if ((slots_[slot] & ~number_mask) != tag) continue;
    const Word* const entry = &entries_[((slots_[slot] & number_mask) - 1) * entry_words_];
    if (std::memcmp(entry, key_.data(), key_words_ * sizeof(Word)) == 0) return entry;
  }
  return nullptr;
}

/// Remembers the solution under the key. Returns the entry.
const Word* Decisions::remember(Memory memory) {
  if (entries_.size() * sizeof(Word) > most_bytes_) forget();
  const std::size_t number = entries_.size() / entry_words_;
  if ((number + 1) * 2 > slots_.size()) grow();
  const std::uint64_t hash = this->hash();
  std::size_t slot = 0;
  static_cast<void>(look_up(hash, slot));
  slots_[slot] = (hash & ~number_mask) | (number + 1);
  entries_.insert(entries_.end(), key_.begin(), key_.end());
  entries_.resize((number + 1) * entry_words_, 0);
  Word* const entry = &entries_[number * entry_words_];
  entry[key_words_] = memory;
  if (memory != solved) return entry;
  const Model::Group& group = model_.groups()[static_cast<std::size_t>(key_.front() >> 32U)];
  for (std::uint32_t task = 0; task < solution_.size(); ++task) {
    if (solution_[task] == none) continue;
    const BitRange values = model_.tasks()[group.tasks.begin + task].values;
    set_bit(entry + key_words_ + 1, values.begin + solution_[task]);
  }
  return entry;
}

void Decisions::write_key(const GroupQuestion& question, bool is_ordered) {
  Word* next = key_.data();
  *next++ = (Word{question.group} << 32U) | question.finished;
  next = std::copy_n(question.domains, value_words_, next);
  next = std::copy_n(question.present, value_words_, next);
  next = std::copy_n(question.must_run, task_words_, next);
  std::fill(next, key_.data() + key_words_, 0);
  sorted_.assign(question.requests.begin(), question.requests.end());
  std::uint16_t* const end = sorted_.data() + sorted_.size();
  std::uint16_t* const unasked = end - question.unasked;
  std::uint16_t* const suspended = unasked - question.suspended;
  std::uint16_t* begin = sorted_.data();
  for (std::uint16_t* const part : {suspended, unasked, end}) {
    if (is_ordered) {
      sort_by_class(begin, part);
    } else {
      std::sort(begin, part);
    }
    begin = part;
  }
  std::size_t place = 0;
  const auto put = [&](std::uint32_t number) {
    next[place / requests_in_word] |= Word{number} << (place % requests_in_word * 16);
    ++place;
  };
  put((is_ordered ? 1U : 0U) + (question.must_not_make_worse ? 2U : 0U));
  put(question.suspended);
  put(question.unasked);
  for (const std::uint16_t task : sorted_) put(task + 1U);
}

/// Keeps the order of the requests of each interaction class only. An insertion sort: there are
/// few.
void Decisions::sort_by_class(std::uint16_t* begin, std::uint16_t* end) const {
  const auto& classes = model_.interaction_classes();
  // A property may ask for a start that no move makes.
  const auto has_none = [&](std::uint16_t task) { return classes[task] == none; };
  if (std::any_of(sorted_.begin(), sorted_.end(), has_none)) return;
  for (std::uint16_t* next = begin; next != end; ++next) {
    for (std::uint16_t* task = next; task != begin && classes[*task] < classes[*(task - 1)];
         --task) {
      std::swap(*task, *(task - 1));
    }
  }
}

std::uint64_t Decisions::hash() const {
  std::uint64_t hash = 0;
  for (const Word word : key_) hash = mix_hash(hash, word);
  return hash;
}

void Decisions::grow() {
  slots_.assign(slots_.size() * 2, 0);
  const std::vector<Word> key = key_;
  const std::size_t entries = entries_.size() / entry_words_;
  for (std::size_t number = 0; number < entries; ++number) {
    std::copy_n(&entries_[number * entry_words_], key_words_, key_.begin());
    const std::uint64_t hash = this->hash();
    std::size_t slot = hash & (slots_.size() - 1);
    while (slots_[slot] != 0) slot = (slot + 1) & (slots_.size() - 1);
    slots_[slot] = (hash & ~number_mask) | (number + 1);
  }
  key_ = key;
}

void Decisions::forget() {
  entries_.clear();
  std::fill(slots_.begin(), slots_.end(), 0);
}

void Decisions::load_problem(const GroupQuestion& question) {
  const CompiledCatalog& catalog = model_.catalog();
  const Model::Group& group = model_.groups()[question.group];
  const TaskId first = catalog.group_tasks[group.number];
  const TaskId end = catalog.group_tasks[group.number + 1];
  problem_.group = group.number;
  problem_.domains.assign(catalog.words[end] - catalog.words[first], 0);
  problem_.may_stop.assign(end - first, 1);
  problem_.present.assign(end - first, none);
  problem_.active.clear();
  for (std::uint32_t task = group.tasks.begin; task < group.tasks.end; ++task) {
    const BitRange values = model_.tasks()[task].values;
    const LocalTask place(task - group.tasks.begin);
    Word* const words =
        problem_.domains.data() + (catalog.words[first + place] - catalog.words[first]);
    if (has_bit(question.must_run, task)) problem_.may_stop[place] = 0;
    for (std::uint32_t value = values.begin; value < values.end; ++value) {
      const std::uint32_t index = value - values.begin;
      if (has_bit(question.domains, value)) set_bit(words, index);
      if (!has_bit(question.present, value)) continue;
      problem_.present[place] = index;
      const std::uint32_t behavior = model_.behavior_of(value);
      if (behavior != question.finished) {
        problem_.active.push_back(model_.behaviors()[behavior].id);
      }
    }
  }
  std::sort(problem_.active.begin(), problem_.active.end());
  problem_.active.erase(std::unique(problem_.active.begin(), problem_.active.end()),
                        problem_.active.end());
  problem_.requests.clear();
  for (const std::uint16_t task : question.requests) {
    problem_.requests.emplace_back(task - group.tasks.begin);
  }
  problem_.suspended = question.suspended;
  problem_.unasked = question.unasked;
}

}  // namespace cbc
