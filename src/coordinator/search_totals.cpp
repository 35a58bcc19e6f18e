#include "coordinator/search_totals.h"

#include <cstddef>

namespace cbc {

void SearchEffort::merge(const SearchEffort& other) {
  events += other.events;
  solutions.merge(other.solutions);
  nodes.merge(other.nodes);
  propagations.merge(other.propagations);
  nanoseconds.merge(other.nanoseconds);
}

void SearchTotals::add(const EventRecord& record) {
  if (record.search == nullptr || !record.search->elapsed) return;
  SearchEffort effort;
  effort.events = 1;
  effort.solutions.add(record.search->result.solutions);
  effort.nodes.add(record.search->result.nodes);
  effort.propagations.add(record.search->result.propagations);
  effort.nanoseconds.add(static_cast<std::uint64_t>(record.search->elapsed->count()));
  all_.merge(effort);
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    if (kinds[kind].verb == record.verb && kinds[kind].origin == record.origin) {
      by_kind_[kind].merge(effort);
    }
  }
}

void SearchTotals::merge(const SearchTotals& other) {
  all_.merge(other.all_);
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    by_kind_[kind].merge(other.by_kind_[kind]);
}

}  // namespace cbc
