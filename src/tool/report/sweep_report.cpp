#include "report/sweep_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "support/json.h"
#include "support/wording.h"
#include "sweep/sweep.h"

namespace cbc {
namespace {

constexpr std::string_view label(SweepKind kind) {
  constexpr std::array<std::string_view, sweep_kinds> labels{"start",
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

std::string describe_reason(const SweepResult& result, const RejectionReason& reason) {
  const auto name_in = [](const std::vector<std::string>& names, std::uint32_t place) {
    return place == none ? std::string() : printable(names[place]);
  };
  const std::string task = name_in(result.task_names, reason.task);
  const std::string behavior = name_in(result.behavior_names, reason.behavior);
  switch (reason.kind) {
    case Reason::Kind::priority:
      return task + " has a request of higher priority itself";
    case Reason::Kind::no_behavior:
      return "no behavior performs " + task;
    case Reason::Kind::is_protected:
      return task + " is protected by its request";
    case Reason::Kind::exclusive:
      return task + " excludes " + name_in(result.task_names, reason.other_task);
    case Reason::Kind::on_request:
      return task + " is not running, and starts on request only";
    case Reason::Kind::requires_task:
      return behavior + " requires " + task;
    case Reason::Kind::performance:
      return fmt::format("{} requires a minimum performance of {}",
                         behavior.empty() ? "the catalog" : behavior, task);
    case Reason::Kind::unavailable:
      return behavior + " cannot be activated in the present situation";
    case Reason::Kind::faulty:
      return behavior + " is faulty";
    case Reason::Kind::finished:
      break;  // of no rejected event
  }
  return {};
}

/// "2.5" for 2500 nanoseconds, to three digits or more.
std::string to_microseconds(std::uint64_t nanoseconds) {
  const double time = static_cast<double>(nanoseconds) / 1000;
  return fmt::format("{:.{}f}", time, time < 10 ? 2 : time < 100 ? 1 : 0);
}

class SweepText {
 public:
  SweepText(const SweepResult& result, const Style& style) : result_(result), style_(style) {}

  [[nodiscard]] std::string write() {
    write_heading();
    write_events();
    write_unused("behaviors that never became active", result_.behavior_names,
                 [&](std::size_t place) { return result_.counts.behaviors[place].activations; });
    write_unused("tasks that never ran", result_.task_names,
                 [&](std::size_t place) { return result_.counts.tasks[place].runs; });
    write_reasons();
    write_nodes();
    if (result_.times) write_times(*result_.times);
    return std::move(text_);
  }

 private:
  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    text_ += fmt::format(format, std::forward<Args>(args)...);
  }

  void write_heading() {
    const SweepSettings& settings = result_.settings;
    add("{}sweep of {}{}: {} of {}, seed {}", style_.strong, printable(result_.catalog),
        style_.reset, quantity(settings.sequences, "sequence"),
        quantity(settings.shape.events, "event"), settings.seed);
    if (settings.shard.count > 1) {
      add(", shard {}/{} of it", settings.shard.index, settings.shard.count);
    }
    add("\n\n");
  }

  void write_events() {
    add("{}{:<28}{:>12}{:>12}{:>12}{:>12}{}\n", style_.faint, "events", "accepted", "escalated",
        "rejected", "unchanged", style_.reset);
    OutcomeCounts all;
    for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
      const OutcomeCounts& counts = result_.counts.events[kind];
      write_outcomes(label(static_cast<SweepKind>(kind)), counts);
      all.accepted += counts.accepted;
      all.escalated += counts.escalated;
      all.rejected += counts.rejected;
      all.unchanged += counts.unchanged;
    }
    write_outcomes("all", all);
    add("\n");
  }

  void write_outcomes(std::string_view name, const OutcomeCounts& counts) {
    add("  {:<26}{:>12}{:>12}{:>12}{:>12}\n", name, counts.accepted, counts.escalated,
        counts.rejected, counts.unchanged);
  }

  template <typename Count>
  void write_unused(std::string_view what, const std::vector<std::string>& names, Count count) {
    constexpr std::size_t most_named = 20;
    std::vector<std::string> unused;
    for (std::size_t place = 0; place < names.size(); ++place) {
      if (count(place) == 0) unused.push_back(printable(names[place]));
    }
    add("{}{}{}: {} of {}\n", style_.strong, what, style_.reset, unused.size(), names.size());
    for (std::size_t place = 0; place < std::min(unused.size(), most_named); ++place) {
      add("  {}\n", unused[place]);
    }
    if (unused.size() > most_named) add("  and {} more\n", unused.size() - most_named);
  }

  void write_reasons() {
    constexpr std::size_t most_shown = 10;
    std::vector<std::pair<RejectionReason, std::uint64_t>> reasons(result_.counts.reasons.begin(),
                                                                   result_.counts.reasons.end());
    if (reasons.empty()) return;
    std::stable_sort(reasons.begin(), reasons.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    add("{}reasons of rejections{}, the most frequent of {}\n", style_.strong, style_.reset,
        reasons.size());
    reasons.resize(std::min(reasons.size(), most_shown));
    for (const auto& [reason, count] : reasons) {
      add("{:>9}  {}\n", count, describe_reason(result_, reason));
    }
  }

  void write_nodes() {
    if (!result_.slowest) {
      add("no event took a search\n");
      return;
    }
    add("{}nodes{} of {}: median {}, 99th percentile {}, largest {}\n", style_.strong, style_.reset,
        quantity(result_.nodes.total(), "solved event"), result_.nodes.median(),
        result_.nodes.percentile_99(), result_.slowest->cost);
    write_slowest(*result_.slowest, "nodes", "--slowest");
  }

  void write_times(const SweepTimes& times) {
    if (!times.slowest) return;
    add("{}time{} of an event in µs: median {}, 99th percentile {}, largest {}\n", style_.strong,
        style_.reset, to_microseconds(times.events.median()),
        to_microseconds(times.events.percentile_99()), to_microseconds(times.slowest->cost));
    write_slowest(*times.slowest, "time", "--slowest-by-time");
    add("elapsed: {} s\n", format_decimal(static_cast<std::int64_t>(times.elapsed / 1000), 3));
  }

  void write_slowest(const SlowestEvent& slowest, std::string_view measure,
                     std::string_view option) {
    add("  slowest by {}: event {} of sequence {}, {} ({} FILE writes a script of it)\n", measure,
        slowest.event, slowest.sequence, printable(slowest.what), option);
  }

  const SweepResult& result_;
  const Style& style_;
  std::string text_;
};

}  // namespace

std::string sweep_to_text(const SweepResult& result, const Style& style) {
  return SweepText(result, style).write();
}

namespace {

using Json = nlohmann::ordered_json;

double to_share(Millionths share) { return share / double{one_million}; }

Json options_to_json(const SweepSettings& settings) {
  const SweepSearch& search = settings.search;
  return {{"events", settings.shape.events},
          {"priorities", settings.shape.priorities},
          {"failures", to_share(settings.shape.failures)},
          {"faults", to_share(settings.shape.faults)},
          {"max_solutions", search.max_solutions},
          {"max_nodes", search.max_nodes},
          {"tie_seed", search.tie_seed ? Json(*search.tie_seed) : Json(nullptr)},
          {"max_clock_events", search.max_clock_events}};
}

std::vector<Json> events_to_json(const SweepCounts& counts) {
  std::vector<Json> items;
  for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
    const OutcomeCounts& of_kind = counts.events[kind];
    items.push_back({{"kind", name_of(static_cast<SweepKind>(kind))},
                     {"accepted", of_kind.accepted},
                     {"escalated", of_kind.escalated},
                     {"rejected", of_kind.rejected},
                     {"unchanged", of_kind.unchanged}});
  }
  return items;
}

std::vector<Json> tasks_to_json(const SweepResult& result) {
  std::vector<Json> items;
  for (std::size_t task = 0; task < result.task_names.size(); ++task) {
    const TaskCounts& counts = result.counts.tasks[task];
    items.push_back({{"task", result.task_names[task]},
                     {"started", counts.starts},
                     {"rejected", counts.rejected},
                     {"runs", counts.runs}});
  }
  return items;
}

std::vector<Json> behaviors_to_json(const SweepResult& result) {
  std::vector<Json> items;
  for (std::size_t behavior = 0; behavior < result.behavior_names.size(); ++behavior) {
    const BehaviorCounts& counts = result.counts.behaviors[behavior];
    items.push_back({{"behavior", result.behavior_names[behavior]},
                     {"activations", counts.activations},
                     {"failures", counts.failures}});
  }
  return items;
}

std::vector<Json> reasons_to_json(const SweepResult& result) {
  std::vector<Json> items;
  for (const auto& [reason, count] : result.counts.reasons) {
    Json& item = items.emplace_back(Json::object());
    item["kind"] = name_of(reason.kind);
    if (reason.behavior != none) item["behavior"] = result.behavior_names[reason.behavior];
    if (reason.other_task != none) {
      item["tasks"] = {result.task_names[reason.task], result.task_names[reason.other_task]};
    } else if (reason.task != none) {
      item["task"] = result.task_names[reason.task];
    }
    item["count"] = count;
  }
  return items;
}

Json slowest_to_json(const std::optional<SlowestEvent>& slowest, const char* unit) {
  if (!slowest) return nullptr;
  return {{"sequence", slowest->sequence},
          {"event", slowest->event},
          {"what", slowest->what},
          {unit, slowest->cost},
          {"script", slowest->script}};
}

Json histogram_to_json(const Histogram& histogram, const std::optional<SlowestEvent>& slowest) {
  Json counts = Json::array();
  for (const auto& [number, count] : histogram.counts()) counts.push_back({number, count});
  return {{"p50", histogram.median()},
          {"p99", histogram.percentile_99()},
          {"max", slowest ? slowest->cost : 0},
          {"histogram", std::move(counts)}};
}

/// Writes an object with one member on a line.
class Members {
 public:
  void add(const char* name, const Json& value) { add_text(name, to_text(value)); }
  /// An array with one item on a line.
  void add(const char* name, const std::vector<Json>& items) {
    std::string array = "[";
    for (const Json& item : items) append_item(array, to_text(item));
    add_text(name, array + "]");
  }
  [[nodiscard]] std::string take() { return std::move(text_) + "}\n"; }

 private:
  void add_text(const char* name, const std::string& value) {
    text_ += text_.empty() ? "{" : ",\n";
    text_ += to_text(name) + ":" + value;
  }

  std::string text_;
};

}  // namespace

std::string sweep_to_json(const SweepResult& result) {
  Json never_active = Json::array();
  for (std::size_t place = 0; place < result.behavior_names.size(); ++place) {
    if (result.counts.behaviors[place].activations == 0) {
      never_active.push_back(result.behavior_names[place]);
    }
  }
  Json never_ran = Json::array();
  for (std::size_t place = 0; place < result.task_names.size(); ++place) {
    if (result.counts.tasks[place].runs == 0) never_ran.push_back(result.task_names[place]);
  }
  const SweepShard& shard = result.settings.shard;
  Members members;
  members.add("schema", "cbc.sweep/1");
  members.add("catalog", result.catalog);
  members.add("digest", result.digest);
  members.add("version", result.version);
  members.add("sequences", result.settings.sequences);
  members.add("seed", result.settings.seed);
  members.add("options", options_to_json(result.settings));
  members.add("shard", Json{{"index", shard.index}, {"count", shard.count}});
  members.add("events", events_to_json(result.counts));
  members.add("tasks", tasks_to_json(result));
  members.add("behaviors", behaviors_to_json(result));
  members.add("never_ran", never_ran);
  members.add("never_active", never_active);
  members.add("reasons", reasons_to_json(result));
  members.add("nodes", histogram_to_json(result.nodes, result.slowest));
  members.add("slowest", slowest_to_json(result.slowest, "nodes"));
  if (result.times) {
    const SweepTimes& times = *result.times;
    members.add("stats", Json{{"elapsed_us", times.elapsed},
                              {"event_ns", histogram_to_json(times.events, times.slowest)},
                              {"slowest", slowest_to_json(times.slowest, "ns")}});
  }
  return members.take();
}

namespace {

using Json = nlohmann::ordered_json;
using Places = std::unordered_map<std::string, std::uint32_t>;

constexpr std::uint64_t any_number = std::numeric_limits<std::uint64_t>::max();

/// Reads members, and keeps the first thing that is wrong. After that whatever it returns means
/// nothing, and loops end soon, as all is empty.
class SweepReader {
 public:
  [[nodiscard]] std::variant<SweepResult, std::string> read(const Json& root) {
    read_all(root);
    if (!fault_.empty()) return std::move(fault_);
    return std::move(result_);
  }

 private:
  void read_all(const Json& root) {
    if (text(root, "schema") != "cbc.sweep/1") return fail("its schema is not 'cbc.sweep/1'");
    result_.catalog = text(root, "catalog");
    result_.digest = text(root, "digest");
    result_.version = text(root, "version");
    read_settings(root);
    read_events(root);
    read_tasks(root);
    read_behaviors(root);
    for (const Json& reason : list(root, "reasons")) read_reason(reason);
    result_.slowest = read_slowest(root, "nodes");
    result_.nodes = read_histogram(member(root, "nodes"));
    check_slowest(result_.slowest, result_.nodes);
    if (root.is_object() && root.contains("stats")) read_times(root["stats"]);
  }

  void read_settings(const Json& root) {
    SweepSettings& settings = result_.settings;
    settings.sequences = number(root, "sequences", 1, largest_count);
    settings.seed = number(root, "seed", 0, any_number);
    const Json& options = member(root, "options");
    settings.shape.events =
        static_cast<std::uint32_t>(number(options, "events", 1, std::uint32_t(-1)));
    settings.shape.priorities = static_cast<std::int32_t>(
        number(options, "priorities", 1, std::numeric_limits<std::int32_t>::max()));
    settings.shape.failures = share(options, "failures");
    settings.shape.faults = share(options, "faults");
    settings.search.max_solutions = number(options, "max_solutions", 0, any_number);
    settings.search.max_nodes = number(options, "max_nodes", 0, any_number);
    if (!member(options, "tie_seed").is_null()) {
      settings.search.tie_seed = number(options, "tie_seed", 0, any_number);
    }
    settings.search.max_clock_events = number(options, "max_clock_events", 1, any_number);
    const Json& shard = member(root, "shard");
    settings.shard.count = number(shard, "count", 1, most_shards);
    settings.shard.index = number(shard, "index", 1, settings.shard.count);
  }

  void read_events(const Json& root) {
    const Json::array_t& events = list(root, "events");
    if (events.size() != sweep_kinds) return fail("'events' has not one item for each kind");
    for (std::size_t kind = 0; kind < sweep_kinds; ++kind) {
      if (text(events[kind], "kind") != name_of(static_cast<SweepKind>(kind))) {
        return fail("the kinds of 'events' are not those of this version");
      }
      OutcomeCounts& counts = result_.counts.events[kind];
      counts.accepted = count(events[kind], "accepted");
      counts.escalated = number(events[kind], "escalated", 0, counts.accepted);
      counts.rejected = count(events[kind], "rejected");
      counts.unchanged = count(events[kind], "unchanged");
    }
  }

  void read_tasks(const Json& root) {
    for (const Json& item : list(root, "tasks")) {
      add_name(text(item, "task"), result_.task_names, places_of_tasks_);
      result_.counts.tasks.push_back(
          {count(item, "started"), count(item, "rejected"), count(item, "runs")});
    }
  }

  void read_behaviors(const Json& root) {
    for (const Json& item : list(root, "behaviors")) {
      add_name(text(item, "behavior"), result_.behavior_names, places_of_behaviors_);
      result_.counts.behaviors.push_back({count(item, "activations"), count(item, "failures")});
    }
  }

  void read_reason(const Json& item) {
    RejectionReason reason;
    reason.kind = kind_of_reason(text(item, "kind"));
    if (item.is_object() && item.contains("behavior")) {
      reason.behavior = find_place(text(item, "behavior"), places_of_behaviors_);
    }
    if (item.is_object() && item.contains("tasks")) {
      const Json::array_t& pair = list(item, "tasks");
      if (pair.size() != 2) return fail("'tasks' of a reason is no pair");
      reason.task = find_place(to_name(pair[0]), places_of_tasks_);
      reason.other_task = find_place(to_name(pair[1]), places_of_tasks_);
    } else if (item.is_object() && item.contains("task")) {
      reason.task = find_place(text(item, "task"), places_of_tasks_);
    }
    check_members(reason);
    result_.counts.reasons[reason] = number(item, "count", 1, largest_count);
  }

  /// Reports look at the members that a reason of its kind has.
  void check_members(const RejectionReason& reason) {
    const bool has_task = reason.task != none;
    const bool has_behavior = reason.behavior != none;
    bool is_right = false;
    switch (reason.kind) {
      case Reason::Kind::priority:
      case Reason::Kind::no_behavior:
      case Reason::Kind::is_protected:
      case Reason::Kind::on_request:
        is_right = has_task;
        break;
      case Reason::Kind::exclusive:
        is_right = has_task && reason.other_task != none;
        break;
      case Reason::Kind::requires_task:
        is_right = has_task && has_behavior;
        break;
      case Reason::Kind::performance:
        is_right = has_task;
        break;
      case Reason::Kind::unavailable:
      case Reason::Kind::faulty:
        is_right = has_behavior;
        break;
      case Reason::Kind::finished:
        break;  // of no rejected event
    }
    if (!is_right) fail("a reason lacks a task or a behavior");
  }

  void read_times(const Json& stats) {
    SweepTimes& times = result_.times.emplace();
    times.elapsed = count(stats, "elapsed_us");
    times.slowest = read_slowest(stats, "ns");
    times.events = read_histogram(member(stats, "event_ns"));
    check_slowest(times.slowest, times.events);
  }

  [[nodiscard]] std::optional<SlowestEvent> read_slowest(const Json& parent, const char* unit) {
    const Json& item = member(parent, "slowest");
    if (item.is_null()) return std::nullopt;
    SlowestEvent slowest;
    slowest.sequence = number(item, "sequence", 1, result_.settings.sequences);
    slowest.event = number(item, "event", 1, largest_count);
    slowest.what = text(item, "what");
    slowest.cost = count(item, unit);
    slowest.script = text(item, "script");
    return slowest;
  }

  [[nodiscard]] Histogram read_histogram(const Json& item) {
    Histogram histogram;
    std::uint64_t next = 0;
    for (const Json& entry : list(item, "histogram")) {
      if (!entry.is_array() || entry.size() != 2 || !entry[0].is_number_unsigned() ||
          !entry[1].is_number_unsigned()) {
        fail("an entry of 'histogram' is no pair of whole numbers");
        break;
      }
      const auto value = entry[0].get<std::uint64_t>();
      const auto times = entry[1].get<std::uint64_t>();
      if (value < next || value > largest_count || Histogram::round_down(value) != value ||
          times == 0 || times > largest_count - histogram.total()) {
        fail("the numbers of 'histogram' are out of range or out of order");
        break;
      }
      histogram.add_rounded(value, times);
      next = value + 1;
    }
    return histogram;
  }

  void check_slowest(const std::optional<SlowestEvent>& slowest, const Histogram& histogram) {
    const bool fits = slowest ? histogram.total() > 0 &&
                                    Histogram::round_down(slowest->cost) == histogram.maximum()
                              : histogram.total() == 0;
    if (!fits) fail("'slowest' does not fit the histogram");
  }

  // Members.

  void fail(std::string fault) {
    if (fault_.empty()) fault_ = std::move(fault);
  }

  [[nodiscard]] const Json& member(const Json& parent, const char* name) {
    static const Json null;
    if (parent.is_object()) {
      const auto found = parent.find(name);
      if (found != parent.end()) return *found;
    }
    fail(fmt::format("it lacks {}", quote(name)));
    return null;
  }

  [[nodiscard]] const Json::array_t& list(const Json& parent, const char* name) {
    static const Json::array_t empty;
    const Json& item = member(parent, name);
    if (item.is_array() && fault_.empty()) return item.get_ref<const Json::array_t&>();
    fail(fmt::format("{} is no list", quote(name)));
    return empty;
  }

  [[nodiscard]] std::string text(const Json& parent, const char* name) {
    const Json& item = member(parent, name);
    if (item.is_string()) return item.get<std::string>();
    fail(fmt::format("{} is no text", quote(name)));
    return {};
  }

  [[nodiscard]] std::string to_name(const Json& item) {
    if (item.is_string()) return item.get<std::string>();
    fail("'tasks' of a reason has no names");
    return {};
  }

  [[nodiscard]] std::uint64_t number(const Json& parent, const char* name, std::uint64_t least,
                                     std::uint64_t most) {
    const Json& item = member(parent, name);
    if (item.is_number_unsigned()) {
      const auto value = item.get<std::uint64_t>();
      if (value >= least && value <= most) return value;
    }
    fail(fmt::format("{} is no whole number from {} to {}", quote(name), least, most));
    return least;
  }

  [[nodiscard]] std::uint64_t count(const Json& parent, const char* name) {
    return number(parent, name, 0, largest_count);
  }

  [[nodiscard]] Millionths share(const Json& parent, const char* name) {
    const Json& item = member(parent, name);
    if (item.is_number()) {
      const auto value = item.get<double>();
      if (value >= 0 && value <= 1)
        return static_cast<Millionths>(std::lround(value * one_million));
    }
    fail(fmt::format("{} is no number from 0 to 1", quote(name)));
    return 0;
  }

  void add_name(std::string name, std::vector<std::string>& names, Places& places) {
    if (!places.emplace(name, static_cast<std::uint32_t>(names.size())).second) {
      fail(fmt::format("{} occurs twice", quote(name)));
    }
    names.push_back(std::move(name));
  }

  [[nodiscard]] std::uint32_t find_place(const std::string& name, const Places& places) {
    const auto found = places.find(name);
    if (found != places.end()) return found->second;
    fail(fmt::format("a reason names {}, which there is not", quote(name)));
    return none;
  }

  [[nodiscard]] Reason::Kind kind_of_reason(const std::string& name) {
    for (int kind = 0; kind <= static_cast<int>(Reason::Kind::faulty); ++kind) {
      if (name_of(static_cast<Reason::Kind>(kind)) == name) return static_cast<Reason::Kind>(kind);
    }
    fail(fmt::format("there is no reason of kind {}", quote(name)));
    return Reason::Kind::priority;
  }

  SweepResult result_;
  Places places_of_tasks_;
  Places places_of_behaviors_;
  std::string fault_;
};

}  // namespace

std::variant<SweepResult, std::string> sweep_from_json(std::string_view text) {
  constexpr std::size_t deepest = 6;  // no sweep has more
  if (nesting_of(text) > deepest) return "it is nested too deep";
  const Json root = Json::parse(text, nullptr, false);
  if (root.is_discarded())
    return "it is no JSON, or cut off; expected what '--shard I/N --format json' writes";
  return SweepReader().read(root);
}

}  // namespace cbc
