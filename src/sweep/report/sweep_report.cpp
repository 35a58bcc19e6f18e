#include "sweep/report/sweep_report.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/report/search_stats.h"
#include "core/support/wording.h"
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

std::string describe_reason(const SweepResult& result, const RejectionReason& reason) {
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
    std::stable_sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) {
      const bool is_last = is_requirement(a.first);
      return is_last != is_requirement(b.first) ? !is_last : a.second > b.second;
    });
    add("{}reasons for rejections{}, the most frequent of {}, requirements last\n", style_.strong,
        style_.reset, reasons.size());
    reasons.resize(std::min(reasons.size(), most_shown));
    for (const auto& [reason, count] : reasons) {
      add("{:>9}  {}\n", count, describe_reason(result_, reason));
    }
  }

  void write_nodes() {
    if (!result_.slowest) {
      add("no event needed a search\n");
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
    add("  slowest by {}: event {} of sequence {}, {} ({} FILE writes it as a script)\n", measure,
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

std::span<const SweepFormat> sweep_formats() {
  static constexpr SweepFormat formats[] = {
      {"text", sweep_to_text},
      {"json", [](const SweepResult& result, const Style&) { return sweep_to_json(result); }},
  };
  return formats;
}

}  // namespace cbc
