#include "report/explanation.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "report/exact_values.h"
#include "report/reasons.h"
#include "text/quote.h"

namespace cbc {
namespace {

/// Digits of a long number that are shown beyond those that two have in common.
constexpr std::size_t digits_beyond = 6;

std::string shorten(const std::string& number, std::size_t length) {
  return number.size() <= length + 1 ? number : number.substr(0, length) + "...";
}

/// Two numbers, long enough to see which is the larger one.
std::pair<std::string, std::string> shorten_both(const std::string& a, const std::string& b) {
  const auto differs = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const auto equal = static_cast<std::size_t>(differs.first - a.begin());
  const std::size_t length = std::max<std::size_t>(equal, 2) + digits_beyond;
  return {shorten(a, length), shorten(b, length)};
}

std::string shorten_alone(const std::string& number) {
  const std::size_t first = std::min(number.find_first_not_of("0."), number.size());
  return shorten(number, std::max<std::size_t>(first, 2) + digits_beyond);
}

std::string task_name(const CompiledCatalog& catalog, TaskId task) {
  return printable(catalog.name_of_task(task));
}

/// The name of a value.
std::string value_name(const CompiledCatalog& catalog, TaskId task, std::uint32_t place) {
  return place == none ? "not running"
                       : printable(catalog.name_of_behavior(catalog.values[task][place].behavior));
}

std::string idle_text(const ObjectiveValues& objective) {
  return fmt::format("{}/{}", objective.idle_total - objective.idle_running, objective.idle_total);
}

/// The first objective in which the alternative loses.
std::string describe_loss(const CompiledCatalog& catalog, const EventRecord& record,
                          const WhyNot& why_not, const State& state) {
  const std::uint32_t group = record.search->group;
  const TaskId first = catalog.group_tasks[group];
  const Configuration& chosen = record.explanation.chosen;
  const Configuration& other = *why_not.alternative;
  const Difference& difference = why_not.difference;
  switch (difference.criterion) {
    case Criterion::requests:
      return fmt::format("{} of {} requests would be satisfied, not {}", other.objective.satisfied,
                         other.objective.requests, chosen.objective.satisfied);
    case Criterion::request_order:
      return fmt::format("{} would not run, whose request comes before that of {}",
                         task_name(catalog, difference.task),
                         task_name(catalog, difference.other_task));
    case Criterion::suitability: {
      const auto [theirs, ours] =
          shorten_both(exact_suitability(catalog, state, group, other.places),
                       exact_suitability(catalog, state, group, chosen.places));
      return fmt::format("suitability would be {}, not {}", theirs, ours);
    }
    case Criterion::idle:
      return fmt::format("idle would be {}, not {}", idle_text(other.objective),
                         idle_text(chosen.objective));
    case Criterion::changes:
      return fmt::format("changes would be {}, not {}", other.objective.changes,
                         chosen.objective.changes);
    case Criterion::canonical: {
      const std::uint32_t task = difference.task - first;
      return fmt::format(
          "all objectives would be the same; of {}, {} comes before {} in the canonical order",
          task_name(catalog, difference.task),
          value_name(catalog, difference.task, chosen.places[task]),
          value_name(catalog, difference.task, other.places[task]));
    }
  }
  return {};
}

/// `condition`: under which the alternative would have been.
Sentences describe(const CompiledCatalog& catalog, const EventRecord& record,
                   const std::string& subject, const std::string& condition, const WhyNot& why_not,
                   TaskId it, const State& state) {
  if (why_not.is_cut) {
    return {subject + ": a limit of effort came before the reason was found", {}};
  }
  if (why_not.alternative) {
    return {fmt::format("{}: {}, {}", subject, condition,
                        describe_loss(catalog, record, why_not, state)),
            {}};
  }
  std::vector<std::string> reasons = describe_reasons(catalog, record, why_not.conflict, it);
  if (reasons.empty()) return {subject + ": the event leaves no other choice", {}};
  if (reasons.size() == 1) return {fmt::format("{}: {}", subject, reasons.front()), {}};
  return {subject + ":", std::move(reasons)};
}

}  // namespace

Sentences describe_displacement(const CompiledCatalog& catalog, const EventRecord& record,
                                const Displacement& displaced, const State& state) {
  return describe(catalog, record, task_name(catalog, displaced.task) + " stops", "if it ran",
                  displaced.why_not, displaced.task, state);
}

Sentences describe_why(const CompiledCatalog& catalog, const EventRecord& record, const Why& why,
                       const State& state) {
  if (why.behavior != none) {
    return describe(
        catalog, record,
        fmt::format("why {} is {}active", printable(catalog.name_of_behavior(why.behavior)),
                    why.is_active ? "" : "not "),
        why.is_active ? "without it" : "with it", why.why_not, none, state);
  }
  const std::string name = task_name(catalog, why.task);
  std::string condition;
  if (why.why_not.alternative) {
    const TaskId first = catalog.group_tasks[record.search->group];
    const std::uint32_t place = why.why_not.alternative->places[why.task - first];
    condition =
        place == none ? "if it did not run" : "with " + value_name(catalog, why.task, place);
  }
  const std::string subject =
      why.chosen == none
          ? fmt::format("why {} does not run", name)
          : fmt::format("why {} has {}", name, printable(catalog.name_of_behavior(why.chosen)));
  return describe(catalog, record, subject, condition, why.why_not, none, state);
}

std::string describe_alternative(const CompiledCatalog& catalog, const EventRecord& record,
                                 std::size_t place, const State& state) {
  const std::vector<Configuration>& list = record.explanation.alternatives;
  const std::uint32_t group = record.search->group;
  const TaskId first = catalog.group_tasks[group];
  const Configuration& configuration = list[place];
  const ObjectiveValues& objective = configuration.objective;
  std::string text =
      fmt::format("requests {}/{}, suitability {}, idle {}, changes {}:", objective.satisfied,
                  objective.requests,
                  shorten_alone(exact_suitability(catalog, state, group, configuration.places)),
                  idle_text(objective), objective.changes);
  bool is_first = true;
  for (std::uint32_t task = 0; task < configuration.places.size(); ++task) {
    const std::uint32_t value = configuration.places[task];
    if (value == (place == 0 ? none : list.front().places[task])) continue;
    text += fmt::format(
        "{} {} {}",
        !is_first    ? ","
        : place == 0 ? ""
                     : " as 1, but",
        task_name(catalog, first + task),
        value == none ? "not running" : "= " + value_name(catalog, first + task, value));
    is_first = false;
  }
  return is_first ? text + " nothing runs" : text;
}

}  // namespace cbc
