#include "report/failure_story.h"

#include <fmt/format.h>

#include "report/describe_event.h"
#include "report/reasons.h"

namespace cbc {

void FailureStory::begin_run(const CompiledCatalog& catalog) {
  catalog_ = &catalog;
  last_ = nullptr;
  rejected_.clear();
  reasons_.clear();
}

void FailureStory::add(const EventRecord& record, const Step* step) {
  last_ = &record;
  last_step_ = step;
  const bool can_be_rejected =
      record.verb == Verb::start || record.verb == Verb::stop || record.verb == Verb::finish;
  if (record.origin != Origin::script || !can_be_rejected) return;
  rejected_.clear();
  reasons_.clear();
  if (record.outcome != Outcome::rejected) return;
  rejected_ = describe(record, step);
  for (const Reason& reason : record.conflict) {
    reasons_.push_back(describe_reason(*catalog_, record, reason));
  }
}

std::vector<std::string> FailureStory::tell() const {
  if (last_ == nullptr) return {"before the first event"};
  const std::string last = describe(*last_, last_step_);
  std::vector<std::string> lines{"after " + last};
  if (rejected_.empty()) return lines;
  if (rejected_ != last) lines.push_back("and after " + rejected_);
  for (const std::string& reason : reasons_) lines.push_back("rejected: " + reason);
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
