#include "core/report/event_json.h"

#include "core/report/event_description.h"
#include "core/report/totals_json.h"
#include "core/script/event_lines.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc {
namespace json::stream {

struct Header {
  const CompiledCatalog& catalog;
  std::string_view catalog_name;
  const CoordinatorOptions& options;
  const Situation& situation;
  std::span<const std::uint32_t> variables;
  std::string_view clock;
};

constexpr auto header = object(
    "header", "The first line: everything that a replay needs except the events.",
    schema_member(events_schema),
    member("catalog", any_text, "The catalog, as given.", &Header::catalog_name),
    member("digest", digest,
           "XXH3-128 digest of the meaning of the catalog: the same for the YAML and the compiled "
           "file, whatever their paths.",
           [](const Header& of) { return to_hex(identity_of(of.catalog)); }),
    member("reactive_delay", positive_seconds,
           "The delay between the time when a reactive task could start and its start, in seconds.",
           [](const Header& of) { return of.options.reactive_delay; }),
    optional("timeouts", always_false,
             "Only in a run without timeouts: the script, or the saved state that the stream "
             "continues from, has timeouts: false.",
             [](const Header& of) { return of.options.timeouts; }),
    member("clock", WordList<2>{{"events", "real"}},
           "Which time lines without at or wait have: events, that of the event before; real, the "
           "time since the start of the program.",
           [](const Header& of) { return of.clock == "real"; }),
    member(
        "situation", event_situation,
        "What the script said of the situation before the first event: behaviors that could be "
        "activated or not, and values of situation variables. Empty if the stream continues from "
        "a saved state (--state-in), which has the situation.",
        [](const Header& of) { return entries_of(of.situation, of.catalog); }),
    optional("variables", event_variables,
             "Of a catalog with situation variables: the values of all of them before the first "
             "event.",
             [](const Header& of) {
               return of.catalog.variables.empty()
                          ? std::nullopt
                          : std::optional(entries_of(of.variables, of.catalog));
             }));

struct Error {
  std::string_view message;
  std::uint64_t line = 0;
};

constexpr auto error =
    object("error",
           "Replaces the event for an input line that is not a valid event. The stream continues.",
           member("error", text, "What is wrong, for people.", &Error::message),
           member("line", line_number, "Line of the input, from 1.", &Error::line));

constexpr auto last_line = object("statistics", "The last line, with --stats.", statistics);

constexpr auto line = choice(
    "One line of the output of `cbc solve --format jsonl` (schema cbc.events/1). The first line is "
    "a header. Then follow an event or an error for each line of the input, and the events of the "
    "clock; at the end, with --stats, totals.",
    header, event, error, last_line);

}  // namespace json::stream

void append_event(std::string& text, const CompiledCatalog& catalog, const ExplainedRecord& record,
                  const Step* step, const State& state, const EventAdditions& adds) {
  JsonWriter json(text);
  const json::EventWithState event{{catalog, record, state}, step, adds, {catalog, state}};
  json::event.write(json, event, static_cast<const json::Decision&>(event));
}

std::string stream_header(const CompiledCatalog& catalog, std::string_view catalog_name,
                          const CoordinatorOptions& options, const Situation& situation,
                          std::span<const std::uint32_t> variables, std::string_view clock) {
  const json::stream::Header header{catalog, catalog_name, options, situation, variables, clock};
  return json::document(json::stream::header, header, catalog);
}

std::string stream_error(std::string_view message, std::uint64_t line) {
  return json::document(json::stream::error, json::stream::Error{message, line});
}

std::string stream_totals(const SearchTotals& totals) {
  return json::document(json::stream::last_line, totals);
}

std::string stream_schema() {
  return json::schema("events", "A line of an event stream", json::stream::line);
}

void EventStream::on_event(const ExplainedRecord& record, const Step* step, const State& state) {
  line_.clear();
  append_event(line_, catalog_, record, step, state, adds_);
  line_ += '\n';
  take_line_({line_, record, step, state});
}

}  // namespace cbc
