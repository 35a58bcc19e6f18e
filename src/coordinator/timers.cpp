#include "coordinator/timers.h"

namespace cbc {

Timers::Timers(std::size_t items) : place_(items, absent) { heap_.reserve(items); }

void Timers::set(Item item, Microseconds due) {
  if (!has(item)) {
    heap_.emplace_back(due, item);
    place_[item] = static_cast<std::uint32_t>(heap_.size() - 1);
  } else {
    heap_[place_[item]].first = due;
  }
  sift_up(place_[item]);
  sift_down(place_[item]);
}

void Timers::remove(Item item) {
  if (!has(item)) return;
  const std::uint32_t place = place_[item];
  place_[item] = absent;
  const auto last = heap_.back();
  heap_.pop_back();
  if (place == heap_.size()) return;
  put(place, last);
  sift_up(place);
  sift_down(place_[last.second]);
}

void Timers::put(std::uint32_t place, const std::pair<Microseconds, Item>& entry) {
  heap_[place] = entry;
  place_[entry.second] = place;
}

void Timers::sift_up(std::uint32_t place) {
  const auto entry = heap_[place];
  while (place > 0 && entry < heap_[(place - 1) / 2]) {
    put(place, heap_[(place - 1) / 2]);
    place = (place - 1) / 2;
  }
  put(place, entry);
}

void Timers::sift_down(std::uint32_t place) {
  const auto entry = heap_[place];
  for (;;) {
    std::uint32_t child = 2 * place + 1;
    if (child >= heap_.size()) break;
    if (child + 1 < heap_.size() && heap_[child + 1] < heap_[child]) ++child;
    if (entry <= heap_[child]) break;
    put(place, heap_[child]);
    place = child;
  }
  put(place, entry);
}

}  // namespace cbc
