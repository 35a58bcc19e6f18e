#include "report/failure_story.h"

#include <fmt/format.h>

#include "report/describe_event.h"
#include "report/explanation.h"
#include "report/reasons.h"
#include "text/quote.h"

namespace cbc {

void FailureStory::begin_run(const CompiledCatalog& catalog) {
  catalog_ = &catalog;
  last_ = nullptr;
  rejected_.clear();
  reasons_.clear();
  stops_.clear();
}

void FailureStory::add(const EventRecord& record, const Step* step, const State& state) {
  last_ = &record;
  last_step_ = step;
  note_stops(record, step, state);
  const bool can_be_rejected =
      record.verb == Verb::start || record.verb == Verb::stop || record.verb == Verb::finish;
  if (record.origin != Origin::script || !can_be_rejected) return;
  rejected_.clear();
  reasons_.clear();
  if (record.outcome != Outcome::rejected) return;
  rejected_ = describe(record, step);
  reasons_ = describe_rejection(*catalog_, record);
}

void FailureStory::note_stops(const EventRecord& record, const Step* step, const State& state) {
  std::erase_if(stops_, [&state](const auto& stop) { return state.is_running(stop.first); });
  for (const StoppedTask& stopped : record.stopped_tasks) {
    Stop& stop = stops_[stopped.task];
    stop = {record.index, {}, describe(record, step)};
  }
  for (const Displacement& displaced : record.explanation.displaced) {
    const Sentences sentences = describe_displacement(*catalog_, record, displaced, state);
    std::vector<std::string>& lines = stops_[displaced.task].lines;
    lines.push_back(sentences.first);
    for (const std::string& sentence : sentences.more) lines.push_back("  " + sentence);
  }
}

std::vector<std::string> FailureStory::tell(const Expectation& failed) const {
  if (last_ == nullptr) return {"before the first event"};
  const std::string last = describe(*last_, last_step_);
  std::vector<std::string> lines{"after " + last};
  if (!rejected_.empty()) {
    if (rejected_ != last) lines.push_back("and after " + rejected_);
    for (const std::string& reason : reasons_) lines.push_back("rejected: " + reason);
  }
  for (const Expectation::Running& expected : failed.running) {
    const auto found = stops_.find(catalog_->task_ids[expected.task]);
    if (found == stops_.end()) continue;
    const Stop& stop = found->second;
    if (stop.event != last_->index) {
      lines.push_back(printable(catalog_->task_names[expected.task]) + " stopped with " +
                      stop.what);
    }
    lines.insert(lines.end(), stop.lines.begin(), stop.lines.end());
  }
  return lines;
}

std::string FailureStory::describe(const EventRecord& record, const Step* step) const {
  const bool has_outcome =
      record.verb == Verb::start || record.verb == Verb::stop || record.verb == Verb::finish;
  return fmt::format("event {} at {} s: {}{}", record.index, format_time(record.time),
                     describe_event(*catalog_, record, step),
                     has_outcome ? fmt::format(": {}", name_of(record.outcome)) : "");
}

}  // namespace cbc
