#include "sweep/report/sweep_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/report/layout.h"
#include "core/report/search_stats.h"
#include "core/report/table.h"
#include "core/support/json.h"
#include "core/support/wording.h"
#include "core/yaml/json_value.h"
#include "runtime/base/text.h"
#include "sweep/engine/sweep.h"

namespace cbc {
namespace {

constexpr std::string_view label(SweepKind kind) {
  constexpr std::array<std::string_view, sweep_kinds> labels = {"start",
                                                                "stop",
                                                                "finish, goal achieved",
                                                                "finish, failure",
                                                                "finish, situation change",
                                                                "situation",
                                                                "fault",
                                                                "repair",
                                                                "timeout",
                                                                "reactive start",
                                                                "finish after a failed undo"};
  return labels[static_cast<std::size_t>(kind)];
}

std::string rejected_because(const SweepResult& result, const RejectionReason& reason) {
  const auto name_in = [](const std::vector<std::string>& names, std::uint32_t place) {
    return place == none ? std::string() : printable(names[place]);
  };
  const std::string task = name_in(result.task_names, reason.task);
  const std::string behavior = name_in(result.behavior_names, reason.behavior);
  switch (reason.kind) {
    case Reason::Kind::priority:
      return task + " has its own request of higher priority";
    case Reason::Kind::no_behavior:
      return "no behavior performs " + task;
    case Reason::Kind::is_protected:
      return task + " is protected by its request";
    case Reason::Kind::exclusive:
      return task + " excludes " + name_in(result.task_names, reason.other_task);
    case Reason::Kind::on_request:
      return task + " starts only on request, and is not requested";
    case Reason::Kind::requires_task:
      return behavior + " requires " + task;
    case Reason::Kind::performance:
      return fmt::format("{} requires a minimum performance of {}",
                         behavior.empty() ? "the catalog" : behavior, task);
    case Reason::Kind::unavailable:
      return behavior + " is unavailable";
    case Reason::Kind::situation:
      return behavior + " does not fit the situation";
    case Reason::Kind::faulty:
      return behavior + " is faulty";
    case Reason::Kind::finished:
    case Reason::Kind::stopped:
      break;  // not reasons of rejections
  }
  return {};
}

/// Whether a reason is a requirement of the catalog. These take part in most rejections, whatever
/// has come about.
bool is_requirement(const RejectionReason& reason) {
  return reason.kind == Reason::Kind::requires_task || reason.kind == Reason::Kind::performance;
}

/// "2.50" for 2500 nanoseconds, with at least three digits.
std::string three_digits(std::uint64_t nanoseconds) {
  const double time = to_microseconds(nanoseconds);
  return fmt::format("{:.{}f}", time, time < 10 ? 2 : time < 100 ? 1 : 0);
}

void add_events(const SweepResult& result, Text& text) {
  Table table(text.style(), {{"events", {}, 28, 0},
                             number_column("accepted", 12, 0),
                             number_column("escalated", 12, 0),
                             number_column("rejected", 12, 0),
                             number_column("unchanged", 12, 0)});
  OutcomeCounts all;
  const auto add = [&](std::string_view name, const OutcomeCounts& counts) {
    table.add({fmt::format("  {}", name), counts.accepted, counts.escalated, counts.rejected,
               counts.unchanged});
  };
  for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
    const OutcomeCounts& counts = result.counts.events[kind];
    add(label(static_cast<SweepKind>(kind)), counts);
    all.accepted += counts.accepted;
    all.escalated += counts.escalated;
    all.rejected += counts.rejected;
    all.unchanged += counts.unchanged;
  }
  add("all", all);
  text.add(table.text() + "\n");
}

/// The names whose count is 0.
template <typename Count>
void add_unused(std::string_view what, const std::vector<std::string>& names, Count count,
                Text& text) {
  constexpr std::size_t most_named = 20;
  std::vector<std::string> unused;
  for (std::size_t place = 0; place < names.size(); ++place) {
    if (count(place) == 0) unused.push_back(printable(names[place]));
  }
  text.line("{}: {} of {}", text.style().paint(text.style().strong, what), unused.size(),
            names.size());
  for (std::size_t place = 0; place < std::min(unused.size(), most_named); ++place) {
    text.line("  " + unused[place]);
  }
  if (unused.size() > most_named) text.line("  and {} more", unused.size() - most_named);
}

void add_reasons(const SweepResult& result, Text& text) {
  constexpr std::size_t most_shown = 10;
  std::vector<std::pair<RejectionReason, std::uint64_t>> reasons(result.counts.reasons.begin(),
                                                                 result.counts.reasons.end());
  if (reasons.empty()) return;
  std::stable_sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) {
    const bool is_last = is_requirement(a.first);
    return is_last != is_requirement(b.first) ? !is_last : a.second > b.second;
  });
  text.line("{}, the most frequent of {}, requirements last",
            text.style().paint(text.style().strong, "reasons for rejections"), reasons.size());
  reasons.resize(std::min(reasons.size(), most_shown));
  Table table(text.style(), {number_column({}, 9, 0), {}});
  for (const auto& [reason, count] : reasons) table.add({count, rejected_because(result, reason)});
  text.add(table.text());
}

void add_slowest(const SlowestEvent& slowest, std::string_view measure, std::string_view option,
                 Text& text) {
  text.line("  slowest by {}: event {} of sequence {}, {} ({} FILE writes it as a script)", measure,
            slowest.event, slowest.sequence, printable(slowest.what), option);
}

void add_nodes(const SweepResult& result, Text& text) {
  if (!result.slowest) return text.line("no event needed a search");
  text.line("{} of {}: median {}, 99th percentile {}, largest {}",
            text.style().paint(text.style().strong, "nodes"),
            quantity(result.nodes.total(), "solved event"), result.nodes.median(),
            result.nodes.percentile_99(), result.slowest->cost);
  add_slowest(*result.slowest, "nodes", "--slowest", text);
}

void add_times(const SweepTimes& times, Text& text) {
  if (!times.slowest) return;
  text.line("{} of an event in µs: median {}, 99th percentile {}, largest {}",
            text.style().paint(text.style().strong, "time"), three_digits(times.events.median()),
            three_digits(times.events.percentile_99()), three_digits(times.slowest->cost));
  add_slowest(*times.slowest, "time", "--slowest-by-time", text);
  text.line("elapsed: {} s", format_decimal(static_cast<std::int64_t>(times.elapsed / 1000), 3));
}

}  // namespace

std::string sweep_to_text(const SweepResult& result, const Style& style) {
  const SweepSettings& settings = result.settings;
  Text text(style);
  text.line("{}: {} of {}, seed {}{}",
            style.paint(style.strong, "sweep of " + printable(result.catalog)),
            quantity(settings.sequences, "sequence"), quantity(settings.shape.events, "event"),
            settings.seed,
            settings.shard.count > 1
                ? fmt::format(", shard {}/{} of it", settings.shard.index, settings.shard.count)
                : "");
  text.line("");
  add_events(result, text);
  add_unused(
      "behaviors that never became active", result.behavior_names,
      [&](std::size_t place) { return result.counts.behaviors[place].activations; }, text);
  add_unused(
      "tasks that never ran", result.task_names,
      [&](std::size_t place) { return result.counts.tasks[place].runs; }, text);
  add_reasons(result, text);
  add_nodes(result, text);
  if (result.times) add_times(*result.times, text);
  return text.take();
}

namespace {

double to_share(Millionths share) { return share / double{one_million}; }

void write_options(JsonWriter& json, const SweepSettings& settings) {
  const SweepSearch& search = settings.search;
  json.on_new_line().write_object("options", {{"events", settings.shape.events},
                                              {"priorities", settings.shape.priorities},
                                              {"failures", to_share(settings.shape.failures)},
                                              {"faults", to_share(settings.shape.faults)},
                                              {"max_solutions", search.max_solutions},
                                              {"max_nodes", search.max_nodes},
                                              {"tie_seed", search.tie_seed},
                                              {"max_clock_events", search.max_clock_events}});
}

void write_events(JsonWriter& json, const SweepCounts& counts) {
  json.on_new_line().open("events", '[');
  for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
    const OutcomeCounts& of_kind = counts.events[kind];
    json.on_new_line().write_object({{"kind", name_of(static_cast<SweepKind>(kind))},
                                     {"accepted", of_kind.accepted},
                                     {"escalated", of_kind.escalated},
                                     {"rejected", of_kind.rejected},
                                     {"unchanged", of_kind.unchanged}});
  }
  json.close(']');
}

void write_tasks(JsonWriter& json, const SweepResult& result) {
  json.on_new_line().open("tasks", '[');
  for (std::size_t task = 0; task < result.task_names.size(); ++task) {
    const TaskCounts& counts = result.counts.tasks[task];
    json.on_new_line().write_object({{"task", result.task_names[task]},
                                     {"started", counts.starts},
                                     {"rejected", counts.rejected},
                                     {"runs", counts.runs}});
  }
  json.close(']');
}

void write_behaviors(JsonWriter& json, const SweepResult& result) {
  json.on_new_line().open("behaviors", '[');
  for (std::size_t behavior = 0; behavior < result.behavior_names.size(); ++behavior) {
    const BehaviorCounts& counts = result.counts.behaviors[behavior];
    json.on_new_line().write_object({{"behavior", result.behavior_names[behavior]},
                                     {"activations", counts.activations},
                                     {"failures", counts.failures}});
  }
  json.close(']');
}

/// The names whose count is 0.
template <typename Count>
void write_unused(JsonWriter& json, std::string_view key, const std::vector<std::string>& names,
                  Count count) {
  json.on_new_line().open(key, '[');
  for (std::size_t place = 0; place < names.size(); ++place) {
    if (count(place) == 0) json.write(names[place]);
  }
  json.close(']');
}

void write_reasons(JsonWriter& json, const SweepResult& result) {
  json.on_new_line().open("reasons", '[');
  for (const auto& [reason, count] : result.counts.reasons) {
    json.on_new_line().open('{');
    json.write("kind", name_of(reason.kind));
    if (reason.behavior != none) json.write("behavior", result.behavior_names[reason.behavior]);
    if (reason.other_task != none) {
      json.write_list("tasks", std::array{reason.task, reason.other_task},
                      [&](std::uint32_t task) { json.write(result.task_names[task]); });
    } else if (reason.task != none) {
      json.write("task", result.task_names[reason.task]);
    }
    json.write("count", count);
    json.close('}');
  }
  json.close(']');
}

void write_slowest(JsonWriter& json, const std::optional<SlowestEvent>& slowest,
                   std::string_view unit) {
  if (!slowest) return json.write("slowest", nullptr);
  json.write_object("slowest", {{"sequence", slowest->sequence},
                                {"event", slowest->event},
                                {"what", slowest->what},
                                {unit, slowest->cost},
                                {"script", slowest->script}});
}

void write_histogram(JsonWriter& json, std::string_view name, const Histogram& histogram,
                     const std::optional<SlowestEvent>& slowest) {
  json.open(name, '{');
  json.write_members({{"p50", histogram.median()},
                      {"p99", histogram.percentile_99()},
                      {"max", slowest ? slowest->cost : 0}});
  json.write_list("histogram", histogram.counts(), [&](const auto& entry) {
    json.open('[');
    json.write(entry.first);
    json.write(entry.second);
    json.close(']');
  });
  json.close('}');
}

}  // namespace

std::string sweep_to_json(const SweepResult& result) {
  const SweepCounts& counts = result.counts;
  const SweepShard& shard = result.settings.shard;
  return json_line([&](JsonWriter& json) {
    json.write("schema", "cbc.sweep/1");
    json.on_new_line().write("catalog", result.catalog);
    json.on_new_line().write("digest", result.digest);
    json.on_new_line().write("version", result.version);
    json.on_new_line().write("sequences", result.settings.sequences);
    json.on_new_line().write("seed", result.settings.seed);
    write_options(json, result.settings);
    json.on_new_line().write_object("shard", {{"index", shard.index}, {"count", shard.count}});
    write_events(json, counts);
    write_tasks(json, result);
    write_behaviors(json, result);
    write_unused(json, "never_ran", result.task_names,
                 [&](std::size_t task) { return counts.tasks[task].runs; });
    write_unused(json, "never_active", result.behavior_names,
                 [&](std::size_t behavior) { return counts.behaviors[behavior].activations; });
    write_reasons(json, result);
    json.on_new_line();
    write_histogram(json, "nodes", result.nodes, result.slowest);
    json.on_new_line();
    write_slowest(json, result.slowest, "nodes");
    if (result.times) {
      json.on_new_line().open("stats", '{');
      json.write("elapsed_us", result.times->elapsed);
      write_histogram(json, "event_ns", result.times->events, result.times->slowest);
      write_slowest(json, result.times->slowest, "ns");
      json.close('}');
    }
  });
}

namespace {

using yaml::JsonFault;
using yaml::JsonValue;
using PlaceByName = std::unordered_map<std::string, std::uint32_t>;

class SweepReader {
 public:
  /// Throws a JsonFault.
  [[nodiscard]] SweepResult read(const JsonValue& root) {
    if (root["schema"].text() != "cbc.sweep/1") throw JsonFault("its schema is not 'cbc.sweep/1'");
    result_.catalog = root["catalog"].text();
    result_.digest = root["digest"].text();
    result_.version = root["version"].text();
    read_settings(root);
    read_events(root["events"].items());
    read_tasks(root["tasks"].items());
    read_behaviors(root["behaviors"].items());
    for (const JsonValue& reason : root["reasons"].items()) read_reason(reason);
    result_.slowest = read_slowest(root["slowest"], "nodes");
    result_.nodes = read_histogram(root["nodes"]);
    check_slowest(result_.slowest, result_.nodes);
    if (const auto stats = root.find("stats")) read_times(*stats);
    return std::move(result_);
  }

 private:
  void read_settings(const JsonValue& root) {
    SweepSettings& settings = result_.settings;
    settings.sequences = root["sequences"].integer<std::uint64_t>(1, largest_count);
    settings.seed = root["seed"].integer<std::uint64_t>();
    const JsonValue options = root["options"];
    settings.shape.events = options["events"].integer<std::uint32_t>(1);
    settings.shape.priorities = options["priorities"].integer<std::int32_t>(1);
    settings.shape.failures = share(options["failures"]);
    settings.shape.faults = share(options["faults"]);
    settings.search.max_solutions = options["max_solutions"].integer<std::uint64_t>();
    settings.search.max_nodes = options["max_nodes"].integer<std::uint64_t>();
    if (const JsonValue seed = options["tie_seed"]; !seed.is_null()) {
      settings.search.tie_seed = seed.integer<std::uint64_t>();
    }
    settings.search.max_clock_events = options["max_clock_events"].integer<std::uint64_t>(1);
    const JsonValue shard = root["shard"];
    settings.shard.count = shard["count"].integer<std::uint64_t>(1, most_shards);
    settings.shard.index = shard["index"].integer<std::uint64_t>(1, settings.shard.count);
  }

  void read_events(const std::vector<JsonValue>& events) {
    if (events.size() != sweep_kinds) {
      throw JsonFault("'events' does not have one item for each kind");
    }
    for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
      if (events[kind]["kind"].text() != name_of(static_cast<SweepKind>(kind))) {
        throw JsonFault("the kinds of 'events' are not those of this version");
      }
      OutcomeCounts& counts = result_.counts.events[kind];
      counts.accepted = count(events[kind]["accepted"]);
      counts.escalated = events[kind]["escalated"].integer<std::uint64_t>(0, counts.accepted);
      counts.rejected = count(events[kind]["rejected"]);
      counts.unchanged = count(events[kind]["unchanged"]);
    }
  }

  void read_tasks(const std::vector<JsonValue>& tasks) {
    for (const JsonValue& item : tasks) {
      add_name(item["task"].text(), result_.task_names, places_of_tasks_);
      result_.counts.tasks.push_back(
          {count(item["started"]), count(item["rejected"]), count(item["runs"])});
    }
  }

  void read_behaviors(const std::vector<JsonValue>& behaviors) {
    for (const JsonValue& item : behaviors) {
      add_name(item["behavior"].text(), result_.behavior_names, places_of_behaviors_);
      result_.counts.behaviors.push_back({count(item["activations"]), count(item["failures"])});
    }
  }

  void read_reason(const JsonValue& item) {
    RejectionReason reason;
    reason.kind = kind_of_reason(item["kind"].text());
    if (const auto behavior = item.find("behavior")) {
      reason.behavior = find_place(*behavior, places_of_behaviors_);
    }
    if (const auto tasks = item.find("tasks")) {
      const std::vector<JsonValue> pair = tasks->items();
      if (pair.size() != 2) throw JsonFault("'tasks' of a reason is not a pair");
      reason.task = find_place(pair[0], places_of_tasks_);
      reason.other_task = find_place(pair[1], places_of_tasks_);
    } else if (const auto task = item.find("task")) {
      reason.task = find_place(*task, places_of_tasks_);
    }
    check_members(reason);
    result_.counts.reasons[reason] = item["count"].integer<std::uint64_t>(1, largest_count);
  }

  /// Reports use the members that a reason of its kind always has.
  static void check_members(const RejectionReason& reason) {
    const bool has_task = reason.task != none;
    const bool has_behavior = reason.behavior != none;
    bool is_right = false;
    switch (reason.kind) {
      case Reason::Kind::priority:
      case Reason::Kind::no_behavior:
      case Reason::Kind::is_protected:
      case Reason::Kind::on_request:
      case Reason::Kind::performance:
        is_right = has_task;
        break;
      case Reason::Kind::exclusive:
        is_right = has_task && reason.other_task != none;
        break;
      case Reason::Kind::requires_task:
        is_right = has_task && has_behavior;
        break;
      case Reason::Kind::unavailable:
      case Reason::Kind::situation:
      case Reason::Kind::faulty:
        is_right = has_behavior;
        break;
      case Reason::Kind::finished:
      case Reason::Kind::stopped:
        break;  // not reasons of rejections
    }
    if (!is_right) throw JsonFault("a reason lacks a task or a behavior");
  }

  void read_times(const JsonValue& stats) {
    SweepTimes& times = result_.times.emplace();
    times.elapsed = count(stats["elapsed_us"]);
    times.slowest = read_slowest(stats["slowest"], "ns");
    times.events = read_histogram(stats["event_ns"]);
    check_slowest(times.slowest, times.events);
  }

  [[nodiscard]] std::optional<SlowestEvent> read_slowest(const JsonValue& item,
                                                         std::string_view unit) const {
    if (item.is_null()) return std::nullopt;
    SlowestEvent slowest;
    slowest.sequence = item["sequence"].integer<std::uint64_t>(1, result_.settings.sequences);
    slowest.event = item["event"].integer<std::uint64_t>(1, largest_count);
    slowest.what = item["what"].text();
    slowest.cost = count(item[unit]);
    slowest.script = item["script"].text();
    return slowest;
  }

  [[nodiscard]] static Histogram read_histogram(const JsonValue& item) {
    Histogram histogram;
    std::uint64_t next = 0;
    for (const JsonValue& entry : item["histogram"].items()) {
      const std::vector<JsonValue> pair = entry.items();
      if (pair.size() != 2) throw JsonFault("an entry of 'histogram' is not a pair");
      const auto value = count(pair[0]);
      const auto times = count(pair[1]);
      if (value < next || Histogram::round_down(value) != value || times == 0 ||
          times > largest_count - histogram.total()) {
        throw JsonFault("the numbers of 'histogram' are out of range or out of order");
      }
      histogram.add_rounded(value, times);
      next = value + 1;
    }
    return histogram;
  }

  static void check_slowest(const std::optional<SlowestEvent>& slowest,
                            const Histogram& histogram) {
    const bool fits = slowest ? histogram.total() > 0 &&
                                    Histogram::round_down(slowest->cost) == histogram.maximum()
                              : histogram.total() == 0;
    if (!fits) throw JsonFault("'slowest' does not fit the histogram");
  }

  [[nodiscard]] static std::uint64_t count(const JsonValue& value) {
    return value.integer<std::uint64_t>(0, largest_count);
  }

  [[nodiscard]] static Millionths share(const JsonValue& value) {
    return static_cast<Millionths>(std::lround(value.number(0, 1, "from 0 to 1") * one_million));
  }

  static void add_name(std::string name, std::vector<std::string>& names, PlaceByName& places) {
    if (!places.emplace(name, static_cast<std::uint32_t>(names.size())).second) {
      throw JsonFault(quote(name) + " occurs twice");
    }
    names.push_back(std::move(name));
  }

  [[nodiscard]] static std::uint32_t find_place(const JsonValue& value, const PlaceByName& places) {
    const std::string name = value.text();
    const auto found = places.find(name);
    if (found == places.end()) {
      throw JsonFault("a reason names " + quote(name) + ", which does not exist");
    }
    return found->second;
  }

  [[nodiscard]] static Reason::Kind kind_of_reason(const std::string& name) {
    for (int kind = 0; kind <= static_cast<int>(Reason::Kind::faulty); ++kind) {
      if (name_of(static_cast<Reason::Kind>(kind)) == name) return static_cast<Reason::Kind>(kind);
    }
    throw JsonFault("there is no reason of kind " + quote(name));
  }

  SweepResult result_;
  PlaceByName places_of_tasks_;
  PlaceByName places_of_behaviors_;
};

}  // namespace

std::variant<SweepResult, std::string> sweep_from_json(std::string_view text) {
  yaml::JsonReader reader;
  const yaml::Node* const root = reader.read(text);
  if (root == nullptr) {
    return reader.fault() + "; --merge reads what '--shard I/N --format json' writes";
  }
  try {
    return SweepReader().read(JsonValue(*root));
  } catch (const JsonFault& fault) {
    return fault.what();
  }
}

std::span<const SweepFormat> sweep_formats() {
  static constexpr SweepFormat formats[] = {
      {"text", sweep_to_text},
      {"json", [](const SweepResult& result, const Style&) { return sweep_to_json(result); }},
  };
  return formats;
}

}  // namespace cbc
