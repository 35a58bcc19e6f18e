#include "why/inquiry.h"

#include <algorithm>
#include <utility>

#include "why/conflict.h"

namespace cbc {

Inquiry::Inquiry(const CompiledCatalog& catalog, Questions questions)
    : catalog_(catalog), questions_(std::move(questions)) {
  if (questions_.failures) journal_.emplace(catalog);
}

void Inquiry::on_decision(const EventRecord& record, const Circumstances& circumstances,
                          const Assignment* solution) {
  is_decided_ = true;
  record_.conflict.clear();
  record_.explanation.clear();
  if (journal_) journal_->note(record, circumstances, solution);
  if (solution == nullptr) {
    if (questions_.rejections) record_.conflict = find_conflict(catalog_, record, circumstances);
  } else if (record.search->result.status == SearchStatus::optimal &&
             has_answers(*circumstances.problem, *solution)) {
    explainer().explain(circumstances, *solution, questions_, record_.explanation);
  }
}

/// Whether there is something to say of an accepted event.
bool Inquiry::has_answers(const Problem& problem, const Assignment& solution) const {
  if (!questions_.why.empty() || questions_.alternatives > 0) return true;
  return questions_.displaced &&
         std::any_of(problem.requests.begin(), problem.requests.end(),
                     [&solution](LocalTask task) { return solution[task] == none; });
}

const ExplainedRecord& Inquiry::on_event(const EventRecord& record, const State& state) {
  static_cast<EventRecord&>(record_) = record;
  if (!is_decided_) {
    record_.conflict.clear();
    record_.explanation.clear();
  }
  is_decided_ = false;
  if (!record_.explanation.why.empty()) explainer().explain_queued(state, record_.explanation);
  return record_;
}

WhyUnmet Inquiry::why_unmet(const State& present, GroupId group, std::span<const Demands> ways) {
  return cbc::why_unmet(catalog_, present, *journal_, explainer(), group, ways);
}

Explainer& Inquiry::explainer() {
  if (!explainer_) explainer_.emplace(catalog_);
  return *explainer_;
}

}  // namespace cbc
