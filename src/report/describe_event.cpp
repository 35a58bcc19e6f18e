#include "report/describe_event.h"

#include <string_view>

#include <fmt/format.h>

#include "report/exact_values.h"
#include "text/quote.h"

namespace cbc {
namespace {

/// Texts with commas between.
class List {
 public:
  void add(std::string_view text) {
    if (!text_.empty()) text_ += ", ";
    text_ += text;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string describe_active(const CompiledCatalog& catalog,
                            const std::vector<std::uint32_t>& behaviors) {
  if (behaviors.empty()) return "no behavior is active";
  List names;
  for (const std::uint32_t behavior : behaviors) {
    names.add(printable(catalog.behavior_names[behavior]));
  }
  return "active exactly: " + names.text();
}

}  // namespace

std::string describe_situation(const CompiledCatalog& catalog,
                               const std::vector<Availability>& situation) {
  std::string text;
  for (const Availability& entry : situation) {
    text += fmt::format("{} {} {}", text.empty() ? "" : ",",
                        printable(catalog.behavior_names[entry.behavior]),
                        entry.available ? "available" : "unavailable");
  }
  return text;
}

std::string format_time(Microseconds time) {
  return fmt::format("{:.{}f}", to_seconds(time), time % 1000 == 0 ? 3 : 6);
}

std::string describe_event(const CompiledCatalog& catalog, const EventRecord& record,
                           const Step* step) {
  std::string text(name_of(record.verb));
  if (record.task != none) {
    text += " " + printable(catalog.name_of_task(record.task));
    text += fmt::format(", priority {}", record.priority);
  }
  if (record.behavior != none) text += " " + printable(catalog.name_of_behavior(record.behavior));
  if (record.verb == Verb::finish) text += fmt::format(", {}", name_of(record.cause));
  if (step != nullptr && record.verb == Verb::situation) {
    text += describe_situation(catalog, step->situation);
  }
  if (step != nullptr && step->parameters) text += " " + printable(step->parameters->json);
  if (record.origin != Origin::script) text += fmt::format(" ({})", name_of(record.origin));
  return text;
}

std::string describe_expectation(const CompiledCatalog& catalog, const Expectation& expectation) {
  List parts;
  if (expectation.outcome) parts.add(fmt::format("outcome {}", name_of(*expectation.outcome)));
  for (const Expectation::Running& expected : expectation.running) {
    std::string part = printable(catalog.task_names[expected.task]) + " runs";
    if (expected.behavior) part += " with " + printable(catalog.behavior_names[*expected.behavior]);
    parts.add(part);
  }
  for (const std::uint32_t task : expectation.stopped) {
    parts.add(printable(catalog.task_names[task]) + " does not run");
  }
  if (expectation.active) parts.add(describe_active(catalog, *expectation.active));
  return parts.text();
}

}  // namespace cbc
