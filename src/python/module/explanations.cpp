#include "python/module/explanations.h"

#include "core/report/event_json.h"
#include "core/script/repetition.h"
#include "core/words/explanation_words.h"
#include "core/words/reason_words.h"
#include "core/words/words.h"
#include "runtime/base/text.h"

namespace cbc::python {
namespace {

void add_line(std::string& text, std::string_view line) {
  if (!text.empty()) text += '\n';
  text += line;
}

void add(std::string& text, const Sentences& sentences, std::string_view indent) {
  add_line(text, concat(indent, sentences.first));
  for (const std::string& sentence : sentences.more) {
    add_line(text, concat(indent, "  ", sentence));
  }
}

/// Does the call once more, and takes one of its events.
void repeat(const PastCall& past, std::uint64_t index, Questions questions,
            const IsStopped& is_stopped, const TakeEvent& take) {
  questions.rejections = true;
  cbc::repeat(*past.catalog->compiled, to_internal(past.options, is_stopped), past.before,
              past.call, questions,
              [&](const ExplainedRecord& record, const Step* step, const State& state) {
                if (record.index == index) take(record, step, state);
              });
}

std::string describe_rejected(const CompiledCatalog& catalog, const ExplainedRecord& record) {
  std::string text;
  add(text, {place_of(catalog, record) + " was rejected:", describe_rejection(catalog, record)},
      "");
  return text;
}

void repeat(const HandledEvent& event, const IsStopped& is_stopped, const TakeEvent& take) {
  repeat(*event.past, event.record.index, {.displaced = true}, is_stopped, take);
}

constexpr std::string_view no_reasons =
    "the search for it ended at the time limit, so nothing says why it is not another one";

}  // namespace

Told tell(const PastCall& past, const ExplainedRecord& record, const State& state) {
  const CompiledCatalog& catalog = *past.catalog->compiled;
  const Step* const step = past.step_of(record);
  Told told;
  add(told.words, {event_and_outcome(catalog, record, step), {std::string(no_reasons)}}, "");
  append_event(told.json, catalog, record, step, state, {});
  return told;
}

std::string explain_event(const HandledEvent& event, const IsStopped& is_stopped) {
  if (event.told != nullptr) return event.told->words;
  const CompiledCatalog& catalog = *event.past->catalog->compiled;
  std::string text;
  repeat(event, is_stopped,
         [&](const ExplainedRecord& record, const Step* step, const State& state) {
           if (record.outcome == Outcome::rejected) {
             text = describe_rejected(catalog, record);
             return;
           }
           text = event_and_outcome(catalog, record, step);
           const std::string note = describe_note(catalog, record, state);
           if (!note.empty()) add(text, {note, {}}, "  ");
           for (const Displacement& displaced : record.explanation.displaced) {
             add(text, describe_displacement(catalog, record, displaced, state), "  ");
           }
         });
  return text;
}

std::string event_to_json(const HandledEvent& event, const IsStopped& is_stopped) {
  if (event.told != nullptr) return event.told->json;
  const CompiledCatalog& catalog = *event.past->catalog->compiled;
  std::string text;
  repeat(event, is_stopped,
         [&](const ExplainedRecord& record, const Step* step, const State& state) {
           append_event(text, catalog, record, step, state, {});
         });
  return text;
}

namespace {

/// A sentence where no event has decided anything.
std::string explain_undecided(const Session& session, TaskId task) {
  const CompiledCatalog& catalog = *session.catalog()->compiled;
  const State& state = session.state();
  UnexpectedTasks unexpected;
  unexpected.group = catalog.tasks[task].group;
  unexpected.tasks = {task};
  const std::uint32_t place = catalog.tasks[task].catalog_index;
  if (state.queue().has(place)) {
    unexpected.why_unmet.kind = WhyUnmet::Kind::due;
    unexpected.why_unmet.queued_task = task;
    unexpected.why_unmet.due = state.queue().due(place);
  } else if (state.is_running(task)) {
    return concat(task_name(catalog, task), " runs with ",
                  behavior_name(catalog, state.behavior(task)),
                  "; no event has decided about it since the state was restored");
  }
  std::string text;
  add(text, describe_unmet(catalog, unexpected, state), "");
  return text;
}

}  // namespace

std::string explain_present(const Session& session, const Subject& subject,
                            const IsStopped& is_stopped) {
  const CompiledCatalog& catalog = *session.catalog()->compiled;
  const TaskId task =
      subject.is_task
          ? catalog.task_ids[subject.catalog_index]
          : catalog.task_of(catalog.performs[catalog.behavior_ids[subject.catalog_index]].front());
  const GroupId group = catalog.tasks[task].group;
  const auto& rejection = session.rejection_of(group);
  if (subject.is_task && rejection && rejection->record.task == task) {
    return explain_event(*rejection, is_stopped);
  }
  const Decision& decision = session.decision_of(group);
  if (decision.past == nullptr) return explain_undecided(session, task);
  if (decision.told != nullptr) {
    return concat("at ", format_time(decision.time), " s, ", decision.told->words);
  }
  std::string text;
  repeat(*decision.past, decision.index, {.why = {subject}}, is_stopped,
         [&](const ExplainedRecord& record, const Step* step, const State& state) {
           text = concat("at ", format_time(record.time), " s, ",
                         event_and_outcome(catalog, record, step));
           for (const Why& why : record.explanation.why) {
             add(text, describe_why(catalog, record, why, state), "  ");
           }
         });
  return text;
}

}  // namespace cbc::python
