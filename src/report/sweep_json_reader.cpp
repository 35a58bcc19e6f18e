#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/sweep_json.h"
#include "sweep/merge.h"
#include "text/json_nesting.h"
#include "text/quote.h"

namespace cbc {
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
