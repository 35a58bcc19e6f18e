#include "core/report/run_json.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/report/event_description.h"
#include "core/report/event_json.h"
#include "core/report/run_report.h"
#include "core/report/search_stats.h"
#include "core/report/totals_json.h"
#include "core/support/json.h"
#include "core/support/json_description.h"
#include "core/support/wording.h"
#include "core/words/failure_explanation.h"
#include "core/words/words.h"

namespace cbc {
namespace json::solve {

/// Why tasks are not as expected.
struct Unexpected {
  const UnexpectedTasks& unexpected;
  const WhyNot& why_not;
  std::span<const Reason> conflict;
  std::span<const TaskId> tasks_in_question;
  const FailureExplanation::Story& story;
};

namespace {

std::string message_of_story(const FailureExplanation::Story& story) {
  std::string message = join(story.sentences, "; ", message_of);
  for (const std::string& note : story.notes) message += "; " + note;
  return message;
}

}  // namespace

constexpr auto why_of = [](const Unexpected& of) -> const WhyUnmet& {
  return of.unexpected.why_unmet;
};

constexpr auto unexpected =
    object(
        "unexpected",
        "Why tasks of one group are not as expected: the best answer that would have met the "
        "expectation is worse than the chosen one, or there is none.",
        member("event", nullable(integer(1)),
               "Index of the event that decided: the last accepted one of the group, or a rejected "
               "start or stop since. Null if there was none, if one is still to come, or if a "
               "reactive task does not start since another task runs that it excludes.",
               [](const Unexpected& of) {
                 const EventRecord* const event = why_of(of).event;
                 return event != nullptr ? &event->index : nullptr;
               }),
        member(
            "tasks", list(task).at_least(1),
            "The tasks that are not as expected, in catalog order.",
            [](const Unexpected& of) -> const auto& { return of.unexpected.tasks; }),
        optional("due", positive_seconds,
                 "When a reactive task that should run starts by itself, in seconds on the clock.",
                 [](const Unexpected& of) {
                   return why_of(of).kind == WhyUnmet::Kind::due ? &why_of(of).due : nullptr;
                 }),
        part(
            [](const Unexpected& of) -> const auto& { return of.why_not; },
            why_not("The best configuration that meets the expectation in this group; null if "
                    "there is none, or no answer.")),
        member(
            "conflict", list(pointed(reason)),
            "Why there is no alternative: a minimal set of reasons. Empty if the event leaves no "
            "choice.",
            [](const Unexpected& of, const Decision& in) {
              return in_order(of.conflict, of.tasks_in_question, in);
            }),
        optional("notes", texts.at_least(1),
                 "What else one has to know, for people: that what prevented it no longer does, "
                 "that nothing was decided since the situation changed, that a fault of an active "
                 "behavior has no effect yet, when a timeout is due. Also at the end of the "
                 "message.",
                 [](const Unexpected& of) {
                   return of.story.notes.empty() ? nullptr : &of.story.notes;
                 }),
        member("message", text,
               "The same as sentences for people; also when and why the tasks stopped, and that "
               "their requests ended with that.",
               [](const Unexpected& of) { return message_of_story(of.story); }))
        .related(R"([
      {"if": {"properties": {"alternative": {"type": "null"}}},
       "then": {"properties": {"loses": {"type": "null"},
         "differences": {"type": "array", "maxItems": 0}}},
       "else": {"properties": {"event": {"type": "integer"},
         "limit_reached": {"const": false},
         "loses": {"type": "object"},
         "differences": {"type": "array", "minItems": 1},
         "conflict": {"type": "array", "maxItems": 0}}}}])");

/// Why tasks are not as a failed expectation, which is the context, wants them.
struct OfFailure {
  struct Context {
    const CompiledCatalog& catalog;
    const Failure& failure;
    const FailureExplanation& explanation;
  };

  void write(JsonWriter& json, const UnexpectedTasks& tasks, const Context& context) const {
    static const ExplainedRecord nothing{};
    static const WhyNot no_answer{};
    const WhyUnmet& why_unmet = tasks.why_unmet;
    const FailureExplanation::Story story = context.explanation.explain(context.failure, tasks);
    if (why_unmet.kind == WhyUnmet::Kind::decided) {
      unexpected.write(
          json,
          Unexpected{tasks, why_unmet.why_not, why_unmet.why_not.conflict, tasks.tasks, story},
          Decision{context.catalog, *why_unmet.event, *why_unmet.before});
      return;
    }
    const bool is_rejected = why_unmet.kind == WhyUnmet::Kind::rejected;
    const ExplainedRecord& event = is_rejected ? *why_unmet.event : nothing;
    unexpected.write(
        json,
        Unexpected{
            tasks, no_answer, is_rejected ? event.conflict : why_unmet.why_not.conflict, {}, story},
        Decision{context.catalog, event, *context.failure.state});
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    unexpected.put_schema(json, definitions);
  }
};

constexpr auto failure = object(
    "failure", "An expectation that does not hold.",
    member("index", count, "Index of the event that it follows; 0 if it comes first.",
           &Failure::index),
    member("line", line_number, "Line of the script, from 1.",
           [](const Failure& of) { return of.range.begin.line; }),
    member("message", text, "What was expected, and what was found, for people.",
           &Failure::message),
    member("why", list(OfFailure()),
           "Why tasks are not as expected, one entry for each group of tasks. Empty if the outcome "
           "alone is wrong, if the expectation can never hold, and after the first 100 failed "
           "expectations of a script.",
           &Failure::unexpected));

constexpr auto success =
    object("success", "An expectation that holds.",
           member("index", count, "Index of the event that it follows; 0 if it comes first.",
                  &Success::index),
           member("line", line_number, "Line of the script, from 1.",
                  [](const Success& of) { return of.step.range.begin.line; }),
           member("message", text, "What was expected, for people.",
                  [](const Success& of, const CompiledCatalog& catalog) {
                    return describe_expectation(catalog, *of.step.expect);
                  }));

constexpr auto run_begin =
    group(member("catalog", any_text,
                 "The catalog, as given; for a compiled catalog, the name of its source.",
                 [](const Script&, const CompiledCatalog& catalog) { return catalog.file; }),
          member("script", any_text, "The script, as given.", &Script::file));

/// Its events are written one by one.
constexpr auto events = member("events", list(event), "All events, in order.",
                               [](const auto&) { return std::span<const EventWithState>(); });

struct RunEnd {
  const RunResult& result;
  const std::string& successes;  ///< as JSON
  const std::string& failures;
  const std::string& error;
};

/// The items of a list, which are JSON already.
template <typename Item>
struct WrittenList {
  Item item;

  void write(JsonWriter& json, std::string_view items, const auto& /*context*/) const {
    json.begin('[');
    json.put_json(items);
    json.close(']');
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    list(item).put_schema(json, definitions);
  }
};

template <typename Item>
WrittenList(Item) -> WrittenList<Item>;

constexpr auto run_end = group(
    member("expectations",
           object("expectations",
                  "The expectations of the script: how many hold, which these are, and what is "
                  "wrong with the others.",
                  member("passed", count, "", [](const RunEnd& of) { return of.result.passed; }),
                  member("failed", count, "", [](const RunEnd& of) { return of.result.failed; }),
                  member(
                      "successes", WrittenList{success}, "Those that hold, in order.",
                      [](const RunEnd& of) -> const auto& { return of.successes; }),
                  member(
                      "failures", WrittenList{failure}, "Those that do not, in order.",
                      [](const RunEnd& of) -> const auto& { return of.failures; })),
           "", std::identity()),
    optional(
        "totals", totals, "With --stats: the effort of the searches of the run.",
        [](const RunEnd& of) -> const auto& { return of.result.totals; }),
    optional("error", text, "Why the run ended early, for people. Absent if it did not end early.",
             [](const RunEnd& of) { return of.error.empty() ? nullptr : &of.error; }));

constexpr auto runs = member(
    "runs",
    list(object("run", "A script run on a catalog.", run_begin, events, run_end)).at_least(1),
    "One run for each script, in the order of the command line; the scripts of a folder are "
    "ordered by name.",
    [](const auto&) { return std::span<const RunEnd>(); });

using Totals = std::optional<SearchTotals>;

constexpr auto report_end = group(
    optional(
        "totals", totals, "With --stats: the effort of the searches of all runs.",
        [](const Totals& of) -> const auto& { return of; }),
    optional("process", process, "",
             [](const Totals& of) { return of ? std::optional(process_usage()) : std::nullopt; }));

constexpr auto report = object("", "The output of `cbc solve --format json` (schema cbc.solve/1).",
                               schema_member("cbc.solve/1"), runs, report_end)
                            .related(R"([
      {"if": {"properties": {"totals": true}, "required": ["totals"]},
       "then": {"properties": {"runs": {"type": "array",
          "items": {"type": "object",
           "properties": {"totals": true},
           "required": ["totals"]}},
         "process": true},
        "required": ["process"]},
       "else": {"properties": {"runs": {"type": "array",
          "items": {"type": "object", "properties": {"totals": false}}},
         "process": false}}}])");

}  // namespace json::solve

std::string solve_schema() {
  return json::schema("solve", "Output of cbc solve", json::solve::report);
}

void append_failure(std::string& text, const CompiledCatalog& catalog, const Failure& failure,
                    const FailureExplanation& explanation) {
  JsonWriter json(text);
  json.begin_item();
  json::solve::failure.write(json, failure,
                             json::solve::OfFailure::Context{catalog, failure, explanation});
}

JsonReport::JsonReport(std::FILE* out, const EventAdditions& adds, bool is_part)
    : out_(out), adds_(adds) {
  if (!is_part) write(R"({"schema":"cbc.solve/1","runs":[)");
}

void JsonReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  catalog_ = &catalog;
  begin_item(is_first_run_, "\n");
  std::string text;
  JsonWriter json(text);
  json.open('{');
  json::solve::run_begin.write(json, script, catalog);
  json.open(json::solve::events.name, '[');
  json.flush();
  write(text);
  is_first_event_ = true;
  explanation_.begin_run(catalog, script);
  successes_.clear();
  failures_.clear();
}

void JsonReport::on_event(const ExplainedRecord& record, const Step* step, const State& state) {
  begin_item(is_first_event_, "\n ");
  event_.clear();
  append_event(event_, *catalog_, record, step, state, adds_);
  write(event_);
  explanation_.add(record, step, state);
}

void JsonReport::on_success(const Success& success) {
  JsonWriter json(successes_);
  json.begin_item();
  json::solve::success.write(json, success, *catalog_);
}

void JsonReport::on_failure(const Failure& failure) {
  append_failure(failures_, *catalog_, failure, explanation_);
}

void JsonReport::end_run(const RunResult& result, const std::string& error) {
  std::string text = "]";
  JsonWriter json(text);
  json::solve::run_end.write(json, json::solve::RunEnd{result, successes_, failures_, error},
                             json::NoContext());
  json.close('}');
  write(text);
  count(result);
}

void JsonReport::count(const RunResult& result) {
  if (!result.totals) return;
  if (!totals_) totals_.emplace();
  totals_->merge(*result.totals);
}

std::unique_ptr<SolveReport> JsonReport::make_part(std::FILE* out) const {
  return std::unique_ptr<SolveReport>(new JsonReport(out, adds_, true));
}

void JsonReport::add_part(std::string_view text, const RunResult& result) {
  if (!is_first_run_) write(",");
  is_first_run_ = false;
  write(text);
  count(result);
}

void JsonReport::end() {
  std::string text = "]";
  JsonWriter json(text);
  json::solve::report_end.write(json, totals_, json::NoContext());
  json.close('}');
  write(text + "\n");
}

void JsonReport::write(std::string_view text) { std::fwrite(text.data(), 1, text.size(), out_); }

void JsonReport::begin_item(bool& is_first, const char* indent) {
  if (!is_first) write(",");
  is_first = false;
  write(indent);
}

}  // namespace cbc
