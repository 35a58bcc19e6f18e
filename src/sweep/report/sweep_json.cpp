#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/support/json_description.h"
#include "runtime/base/text.h"
#include "sweep/engine/sweep.h"
#include "sweep/report/sweep_report.h"

namespace cbc {
namespace json::sweep {

constexpr Integer number_of_events = integer(0, largest_count);
constexpr Integer place_from_1 = integer(1, largest_count);

/// Millionths as a number from 0 to 1.
struct Share {
  void write(JsonWriter& json, Millionths value, const auto& /*context*/) const {
    json.put(value / double{one_million});
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    json::share.put_schema(json, definitions);
  }
};

constexpr auto options = object(
    "options", "Other options that the events and the answers depend on.",
    part(&SweepSettings::shape,
         group(member("events", integer(1),
                      "Number of events in each sequence, not counting events of the clock "
                      "(--events).",
                      &SweepShape::events),
               member("priorities", integer(1),
                      "Requests have priorities from 1 to this (--priorities).",
                      &SweepShape::priorities),
               member("failures", Share(),
                      "The share of finished behaviors that have failed (--failures).",
                      &SweepShape::failures),
               member("faults", Share(),
                      "The share of events that are faults, repairs and changes of the situation "
                      "(--faults).",
                      &SweepShape::faults))),
    part(&SweepSettings::search,
         group(member("max_solutions", count, "--max-solutions; 0: no limit.",
                      &SweepSearch::max_solutions),
               member("max_nodes", count, "--max-nodes; 0: no limit.", &SweepSearch::max_nodes),
               member("max_clock_events", integer(1),
                      "Limit of clock events in each sequence (--max-clock-events).",
                      &SweepSearch::max_clock_events))));

constexpr auto outcomes =
    group(member("accepted", number_of_events, "", &OutcomeCounts::accepted),
          member("escalated", number_of_events,
                 "The accepted events that had no solution until tasks with higher priorities were "
                 "allowed to stop.",
                 &OutcomeCounts::escalated),
          member("rejected", number_of_events, "", &OutcomeCounts::rejected),
          member("unchanged", number_of_events, "", &OutcomeCounts::unchanged));

using OfKind = std::pair<SweepKind, OutcomeCounts>;

constexpr auto kind_with_outcomes = object(
    "outcomes", "",
    member("kind", words(SweepKind::reconsider),
           "finish_success: cause goal_achieved. finish_failure: cause time_out, wrong_progress, "
           "process_failure or interrupted. finish_situation_change: cause situation_change. "
           "timeout: a finish caused by the clock. reactive_start: a start caused by the clock. "
           "finish_lost: a finish of a behavior that a rejected event could not activate again.",
           &OfKind::first),
    part(&OfKind::second, outcomes));

/// The outcomes of all kinds of events, in the order of the kinds.
struct Events {
  using Counts = std::array<OutcomeCounts, sweep_kinds>;

  void write(JsonWriter& json, const Counts& counts, const auto& context) const {
    const auto each = [&](const auto& put) {
      for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
        if (static_cast<SweepKind>(kind) == SweepKind::reconsider && counts.at(kind).is_zero()) {
          continue;
        }
        put(OfKind(static_cast<SweepKind>(kind), counts.at(kind)));
      }
    };
    list(kind_with_outcomes).on_lines().write(json, each, context);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    json.write("type", "array");
    json.open("prefixItems", '[');
    for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
      json.open('{');
      kind_with_outcomes.put_schema(json, definitions);
      json.write("type", "object");
      json.open("properties", '{');
      json.write_object("kind", {{"const", name_of(static_cast<SweepKind>(kind))}});
      json.close('}');
      json.close('}');
    }
    json.close(']');
    json.write("minItems", sweep_kinds - 1);
    json.write("items", false);
  }
};

constexpr auto task_counts =
    group(member("started", number_of_events, "Accepted start events, except reactive ones.",
                 &TaskCounts::starts),
          member("rejected", number_of_events, "Rejected start events, except reactive ones.",
                 &TaskCounts::rejected),
          member("runs", number_of_events, "How often it started to run, for any reason.",
                 &TaskCounts::runs));

constexpr auto behavior_counts =
    group(member("activations", number_of_events,
                 "Successful activations, including restarts, but not those that roll back a "
                 "deactivation of the same event.",
                 &BehaviorCounts::activations),
          member("failures", number_of_events, "Failed activations.", &BehaviorCounts::failures));

constexpr auto first_of = [](auto& of) -> auto& { return of.first; };
constexpr auto second_of = [](auto& of) -> auto& { return of.second; };

/// Pairs of a name and what is counted of it.
constexpr auto counted = [](std::string_view key, auto counts) {
  return list(object("", "", member(key, text, "", first_of), part(second_of, counts))).on_lines();
};

constexpr auto each = [](const std::vector<std::string>& names, const auto& counts) {
  return [&](const auto& put) {
    for (std::size_t place = 0; place < names.size(); ++place) {
      put(std::pair<const std::string&, decltype(counts[place])>(names[place], counts[place]));
    }
  };
};

constexpr auto tasks =
    member("tasks", counted("task", task_counts), "All tasks, in catalog order.",
           [](const SweepResult& of) { return each(of.task_names, of.counts.tasks); });
constexpr auto behaviors =
    member("behaviors", counted("behavior", behavior_counts), "All behaviors, in catalog order.",
           [](const SweepResult& of) { return each(of.behavior_names, of.counts.behaviors); });

/// A task or a behavior, by its place.
template <std::vector<std::string> SweepResult::*names>
struct Place {
  [[nodiscard]] static bool has(std::uint32_t place) { return place != none; }
  void write(JsonWriter& json, std::uint32_t place, const SweepResult& result) const {
    json.put((result.*names)[place]);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    text.put_schema(json, definitions);
  }
};
constexpr Place<&SweepResult::task_names> task;
constexpr Place<&SweepResult::behavior_names> behavior;

using CountedReason = std::pair<RejectionReason, std::uint64_t>;

constexpr auto task_of_reason = member("task", task, "", &RejectionReason::task);
constexpr auto behavior_of_reason = member("behavior", behavior, "", &RejectionReason::behavior);
/// Members of the reason, which is counted.
constexpr auto of_reason = [](auto... members) { return part(first_of, group(members...)); };

/// The two tasks of an exclusion.
struct BothTasks {
  void write(JsonWriter& json, const RejectionReason& reason, const SweepResult& result) const {
    both.write(json, std::array{reason.task, reason.other_task}, result);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    both.put_schema(json, definitions);
  }
  static constexpr auto both = list(task).exactly(2).unique();
};

using Kind = Reason::Kind;

constexpr auto reason = variants(
    "reason", "A reason, as in `conflict` of cbc.solve/1.", group(), "kind",
    [](auto& of) -> auto& { return of.first.kind; },
    group(member("count", place_from_1, "", second_of)),
    variant({Kind::is_protected, Kind::priority, Kind::no_behavior, Kind::on_request,
             Kind::makes_worse},
            "", of_reason(task_of_reason)),
    variant({Kind::unavailable, Kind::situation, Kind::faulty, Kind::not_retried}, "",
            of_reason(behavior_of_reason)),
    variant({Kind::limited}, "",
            of_reason(member("line", line_number, "That of the list in the catalog.",
                             &RejectionReason::line))),
    variant({Kind::not_improved}, "", of_reason(task_of_reason, behavior_of_reason)),
    variant({Kind::exclusive}, "", member("tasks", BothTasks(), "", first_of)),
    variant({Kind::requires_task}, "", of_reason(behavior_of_reason, task_of_reason)),
    variant({Kind::performance}, "",
            of_reason(optional("behavior", behavior,
                               "The behavior that requires it; absent if it is the minimum of the "
                               "task itself.",
                               &RejectionReason::behavior),
                      task_of_reason)));

constexpr auto reasons = member(
    "reasons", list(reason).on_lines(),
    "The number of rejections in which each reason occurs, regardless of its priorities.",
    [](const SweepResult& of) -> const auto& { return of.counts.reasons; });

/// Numbers with how often each occurred.
struct Counts {
  void write(JsonWriter& json, const Histogram& histogram, const auto& context) const {
    pairs.write(json, histogram.counts(), context);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    pairs.put_schema(json, definitions);
  }
  static constexpr auto pairs =
      list(row(item(number_of_events, first_of), item(place_from_1, second_of)));
};

/// What events cost: `histogram` and `slowest` of an object.
struct Costs {
  const Histogram& histogram;
  const std::optional<SlowestEvent>& slowest;
};

constexpr auto histogram = member(
    "histogram", Counts(),
    "Each number with its count, in ascending order. Numbers from 1024 on are rounded down to 10 "
    "binary digits, and so are the percentiles.",
    [](const Costs& of) -> const auto& { return of.histogram; });

constexpr auto distribution =
    object("distribution", "",
           member("p50", count, "The median; 0 if there are no numbers.",
                  [](const Costs& of) { return of.histogram.median(); }),
           member("p99", count, "The 99th percentile.",
                  [](const Costs& of) { return of.histogram.percentile_99(); }),
           member("max", count, "The exact largest number.",
                  [](const Costs& of) { return of.slowest ? of.slowest->cost : 0; }),
           histogram);

constexpr auto slowest = [](std::string_view name, std::string_view unit,
                            std::string_view meaning) {
  return object(
      name, "",
      member("sequence", place_from_1, "Number of the sequence, from 1.", &SlowestEvent::sequence),
      member("event", place_from_1, "Index of the event in the sequence, from 1.",
             &SlowestEvent::event),
      member("what", text, "The event, for people.", &SlowestEvent::what),
      member(unit, number_of_events, meaning, &SlowestEvent::cost),
      member("script", text, "An event script in YAML that reproduces the event and ends with it.",
             &SlowestEvent::script));
};

constexpr auto event_times =
    member("event_ns", distribution,
           "Time of an event in nanoseconds, over the events that needed a search.",
           [](const SweepTimes& of) {
             return Costs{of.events, of.slowest};
           });

constexpr auto stats = optional(
    "stats",
    object("stats", "With --stats: times, which differ from run to run.",
           member("elapsed_us", number_of_events, "Elapsed time in microseconds.",
                  &SweepTimes::elapsed),
           event_times,
           member("slowest", nullable(slowest("longest", "ns", "Time in nanoseconds.")),
                  "The first event with the longest time; null if no event needed a search.",
                  &SweepTimes::slowest)),
    "", &SweepResult::times);

constexpr auto nodes =
    member("nodes", distribution,
           "Decisions in the searches of an event, over the events that needed a search.",
           [](const SweepResult& of) {
             return Costs{of.nodes, of.slowest};
           });

/// The names whose count is 0.
constexpr auto unused = [](const std::vector<std::string>& names, const auto& counts, auto count) {
  return [&names, &counts, count](const auto& put) {
    for (std::size_t place = 0; place < names.size(); ++place) {
      if (std::invoke(count, counts[place]) == 0) put(names[place]);
    }
  };
};

constexpr auto swept_difference = object(
    "difference", "",
    member("line", text, "What is decided differently, for people.", &SweptDifference::line),
    member("sequences", place_from_1, "How many sequences show it.", &SweptDifference::sequences),
    member("sequence", place_from_1,
           "The sequence that shows it after the fewest events; of several the first.",
           &SweptDifference::sequence),
    member("events", place_from_1, "The number of these events.", &SweptDifference::events),
    member("script", text,
           "They, as an event script in YAML for `catalog`, which expects what that decides.",
           &SweptDifference::script));

constexpr auto against = optional(
    "against",
    object(
        "against", "With --against: how an older version of the catalog decides these events.",
        member("catalog", any_text, "The older version, as given.", &SweptComparison::old_catalog),
        member("digest", digest, "Its digest.", &SweptComparison::old_digest),
        part(&SweptComparison::names,
             group(member("only_old", names, "What only the older one has, in words.",
                          &CatalogNames::only_old),
                   member("only_new", names, "What only the newer one has, in words.",
                          &CatalogNames::only_new),
                   member("renamed", names, "What is the same by --renamed, in words.",
                          &CatalogNames::renamed))),
        member("events", number_of_events,
               "The number of starts, stops and finishes of the sequences that were compared.",
               &SweptComparison::events),
        member("sequences", number_of_events, "The number of sequences with a difference.",
               &SweptComparison::sequences),
        member("differences", list(swept_difference).on_lines(), "The most frequent first.",
               &SweptComparison::differences)),
    "", &SweepResult::against);

constexpr auto report = object(
    "",
    "The output of `cbc sweep --format json` (schema "
    "cbc.sweep/1): what happened in N random sequences of events on a catalog. Except for "
    "`stats`, it is the same on every machine; counts of parts of a sweep add up to those of the "
    "whole.",
    schema_member("cbc.sweep/1"),
    member("catalog", any_text,
           "The catalog, as given; for a compiled catalog, the name of its source.",
           &SweepResult::catalog)
        .on_line(),
    member("digest", digest,
           "XXH3-128 digest of the meaning of the catalog: the same for the YAML and the compiled "
           "file, whatever their paths.",
           &SweepResult::digest)
        .on_line(),
    member("version", version_number, "Version of cbc; another version may draw other events.",
           &SweepResult::version)
        .on_line(),
    part(&SweepResult::settings,
         group(member("sequences", place_from_1, "Number of sequences (--sequences).",
                      &SweepSettings::sequences)
                   .on_line(),
               member("first_sequence", place_from_1,
                      "Number of the first one: 1, unless --sequences FIRST-LAST was given.",
                      [](const SweepSettings& of) { return of.first + 1; }),
               member("seed", count, "The seed (--seed).", &SweepSettings::seed).on_line(),
               member("options", options, "", std::identity()).on_line())),
    part(&SweepResult::counts,
         member("events", Events(),
                "The number of events with each outcome, for each kind of event, in this order.",
                &SweepCounts::events)
             .on_line()),
    tasks.on_line(), behaviors.on_line(),
    member("never_ran", names, "The tasks with no `runs`, in catalog order.",
           [](const SweepResult& of) {
             return unused(of.task_names, of.counts.tasks, &TaskCounts::runs);
           })
        .on_line(),
    member("never_active", names, "The behaviors with no `activations`, in catalog order.",
           [](const SweepResult& of) {
             return unused(of.behavior_names, of.counts.behaviors, &BehaviorCounts::activations);
           })
        .on_line(),
    reasons.on_line(), nodes.on_line(),
    member("slowest", nullable(slowest("slowest", "nodes", "Number of decisions.")),
           "The first event with the most nodes; null if no event needed a search.",
           &SweepResult::slowest)
        .on_line(),
    stats.on_line(), against.on_line());

}  // namespace json::sweep

std::string sweep_to_json(const SweepResult& result) {
  return json::document(json::sweep::report, result, result);
}

std::string sweep_schema() {
  return json::schema("sweep", "Result of a sweep", json::sweep::report);
}

}  // namespace cbc
