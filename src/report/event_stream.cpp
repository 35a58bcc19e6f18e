#include "report/event_stream.h"

#include <nlohmann/json.hpp>

#include "compiled/digest.h"
#include "compiled/identity.h"
#include "report/event_json.h"
#include "report/process_usage.h"
#include "report/solve_stats.h"
#include "text/json_text.h"

namespace cbc {

std::string stream_header(const CompiledCatalog& catalog, std::string_view catalog_name,
                          Microseconds reactive_delay, std::span<const Availability> situation) {
  std::string text = R"({"schema":"cbc.events/1","catalog":)";
  append_text(text, catalog_name);
  text += R"(,"digest":)";
  append_text(text, to_hex(identity_of(catalog)));
  text += R"(,"reactive_delay":)";
  append_seconds(text, reactive_delay);
  text += R"(,"situation":{)";
  for (const Availability& entry : situation) {
    if (text.back() != '{') text += ',';
    append_text(text, catalog.behavior_names[entry.behavior]);
    text += entry.available ? ":true" : ":false";
  }
  return text += "}}\n";
}

std::string stream_error(std::string_view message, std::uint64_t line) {
  std::string text = R"({"error":)";
  append_text(text, message);
  text += R"(,"line":)";
  append_integer(text, line);
  return text += "}\n";
}

std::string stream_totals(const SearchTotals& totals) {
  return R"({"totals":)" + to_text(stats_to_json(totals)) + R"(,"process":)" +
         to_text(usage_to_json(process_usage())) + "}\n";
}

void EventStream::on_event(const EventRecord& record, const Step* step, const State& state) {
  line_.clear();
  append_event(line_, catalog_, record, step, state, adds_);
  line_ += '\n';
  take_line_(line_);
}

}  // namespace cbc
