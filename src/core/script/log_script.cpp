#include "core/script/log_script.h"

#include <cstdint>
#include <utility>

#include "core/script/event_lines.h"
#include "runtime/base/text.h"

namespace cbc {

std::optional<Script> read_log(std::string_view text, const CompiledCatalog& catalog,
                               std::string& error) {
  EventLog log(catalog);
  text = utf8::without_byte_order_mark(text);
  const auto header = log.read_header(take_line(text));
  if (!header) {
    error = log.error();
    return std::nullopt;
  }
  Script script;
  script.reactive_delay = header->reactive_delay;
  script.timeouts = header->timeouts;
  script.situation = header->situation;
  Microseconds last = 0;
  bool is_first = true;
  for (std::uint32_t number = 2; !text.empty(); ++number) {
    auto entry = log.read_entry(take_line(text), number);
    if (!entry) {
      error = concat("line ", number, ": ", log.error());
      return std::nullopt;
    }
    if (!entry->is_event) continue;
    if (std::exchange(is_first, false) && entry->index != 1) {
      error = concat("line ", number, ": it continues from a saved state");
      return std::nullopt;
    }
    if (entry->time < last) {
      error = concat("line ", number, ": time goes back");
      return std::nullopt;
    }
    last = entry->time;
    if (entry->step) script.steps.push_back(std::move(*entry->step));
  }
  if (script.steps.empty() || script.steps.back().time < last) {
    Step& end = script.steps.emplace_back();
    end.time = last;
  }
  return script;
}

}  // namespace cbc
