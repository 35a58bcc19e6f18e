#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/report/search_stats.h"
#include "core/report/totals_json.h"
#include "core/script/runner.h"
#include "core/support/json_description.h"
#include "runtime/coordinator/coordinator.h"
#include "unit/compiled_fixture.h"

namespace cbc::search_totals_test {
namespace {

using nlohmann::json;

EventRecord event_of(Verb verb, Origin origin, const SearchRecord* search) {
  EventRecord record;
  record.verb = verb;
  record.origin = origin;
  record.search = search;
  return record;
}

SearchRecord search_of(std::uint64_t solutions, std::uint64_t nodes, std::uint64_t propagations,
                       std::int64_t nanoseconds) {
  SearchRecord search;
  search.result.solutions = solutions;
  search.result.nodes = nodes;
  search.result.propagations = propagations;
  search.elapsed = std::chrono::nanoseconds(nanoseconds);
  return search;
}

json to_json(const SearchTotals& totals) {
  return json::parse(cbc::json::document(cbc::json::totals, totals));
}

TEST(SearchTotals, SumUpByKindAndInAll) {
  const SearchRecord small = search_of(1, 0, 7, 1500);
  const SearchRecord large = search_of(4, 10, 9, 2500);
  SearchTotals totals;
  totals.add(event_of(Verb::start, Origin::script, &small));
  totals.add(event_of(Verb::start, Origin::script, &large));
  totals.add(event_of(Verb::finish, Origin::timeout, &large));
  EXPECT_EQ(to_json(totals), json::parse(R"({
    "events": 3,
    "solutions": {"sum": 9, "mean": 3.0, "min": 1, "max": 4},
    "nodes": {"sum": 20, "mean": 6.666666666666667, "min": 0, "max": 10},
    "propagations": {"sum": 25, "mean": 8.333333333333334, "min": 7, "max": 9},
    "elapsed_us": {"sum": 6.5, "mean": 2.1666666666666665, "min": 1.5, "max": 2.5},
    "kinds": [
      {"verb": "start", "origin": "script", "events": 2,
       "solutions": {"sum": 5, "mean": 2.5, "min": 1, "max": 4},
       "nodes": {"sum": 10, "mean": 5.0, "min": 0, "max": 10},
       "propagations": {"sum": 16, "mean": 8.0, "min": 7, "max": 9},
       "elapsed_us": {"sum": 4.0, "mean": 2.0, "min": 1.5, "max": 2.5}},
      {"verb": "finish", "origin": "timeout", "events": 1,
       "solutions": {"sum": 4, "mean": 4.0, "min": 4, "max": 4},
       "nodes": {"sum": 10, "mean": 10.0, "min": 10, "max": 10},
       "propagations": {"sum": 9, "mean": 9.0, "min": 9, "max": 9},
       "elapsed_us": {"sum": 2.5, "mean": 2.5, "min": 2.5, "max": 2.5}}]})"));
}

TEST(SearchTotals, OfPartsAreThoseOfAll) {
  const std::vector<SearchRecord> searches = {search_of(1, 2, 3, 4), search_of(9, 8, 7, 6),
                                              search_of(5, 5, 5, 5)};
  SearchTotals all;
  SearchTotals sum;
  for (const SearchRecord& search : searches) {
    all.add(event_of(Verb::stop, Origin::script, &search));
    SearchTotals part;
    part.add(event_of(Verb::stop, Origin::script, &search));
    sum.merge(part);
  }
  sum.merge(SearchTotals());
  EXPECT_EQ(to_json(sum), to_json(all));
}

TEST(SearchTotals, LeaveOutEventsWithoutSearch) {
  SearchTotals totals;
  totals.add(event_of(Verb::wait, Origin::script, nullptr));
  EXPECT_EQ(to_json(totals)["events"], 0);
  EXPECT_EQ(to_json(totals)["nodes"],
            json::parse(R"({"sum": 0, "mean": null, "min": null, "max": null})"));
  EXPECT_NE(stats_table(totals, {}, plain_style()).find("  none\n"), std::string::npos);
}

TEST(StatsTable, HasARowForEachMeasure) {
  const SearchRecord small = search_of(1, 0, 7, 1500);
  const SearchRecord large = search_of(4, 10, 9, 2500);
  SearchTotals totals;
  totals.add(event_of(Verb::stop, Origin::script, &small));
  totals.add(event_of(Verb::finish, Origin::situation, &large));
  EXPECT_EQ(stats_table(totals, {3 << 20, 1'250'000}, plain_style()),
            "searches\n"
            "  event                     n                       mean         min         max\n"
            "  stop                      1  solutions            1.00           1           1\n"
            "                               nodes                0.00           0           0\n"
            "                               propagations         7.00           7           7\n"
            "                               time [us]            1.50        1.50        1.50\n"
            "  finish (situation)        1  solutions            4.00           4           4\n"
            "                               nodes               10.00          10          10\n"
            "                               propagations         9.00           9           9\n"
            "                               time [us]            2.50        2.50        2.50\n"
            "  all                       2  solutions            2.50           1           4\n"
            "                               nodes                5.00           0          10\n"
            "                               propagations         8.00           7           9\n"
            "                               time [us]            2.00        1.50        2.50\n"
            "  process: 3.0 MiB of memory at most, 1.250 s of CPU time\n");
}

TEST(ProcessUsage, GrowsWithWhatTheProcessTakes) {
  const ProcessUsage before = process_usage();
  EXPECT_GT(before.peak_memory, 1U << 20);
  std::vector<char> memory(std::size_t{64} << 20, 'x');
  EXPECT_EQ(memory.back(), 'x');
  const ProcessUsage after = process_usage();
  EXPECT_GE(after.peak_memory, std::size_t{64} << 20);
  EXPECT_GE(after.cpu_time, before.cpu_time);
}

// What the coordinator notes of a search.

class LastSearch final : public EventListener {
 public:
  explicit LastSearch(bool measures_time) {
    CoordinatorOptions options;
    options.measure_time = measures_time;
    Coordinator coordinator(catalog_, options, *this);
    coordinator.begin({});
    Event event;
    event.verb = Verb::start;
    event.subject = *catalog_.find_task("A");
    EXPECT_EQ(coordinator.handle(event), Coordinator::Status::ok);
  }
  void on_event(const EventRecord& record) override {
    if (record.search != nullptr) search = *record.search;
  }

  SearchRecord search;

 private:
  // A requires B, which excludes C; D has nothing to do with them.
  const CompiledCatalog catalog_ = test::compile_text(R"(
behaviors:
- {behavior: a, task: A, requires: [{task: B}]}
- {behavior: b, task: B}
- {behavior: c, task: C}
- {behavior: d, task: D}
tasks:
- {task: A}
- {task: B, start_on_request: false}
- {task: C}
- {task: D}
exclusivity_constraints:
- mutually_exclusive: [B, C]
)");
};

TEST(Search, NotesItsTimeOnlyIfItIsToBeMeasured) {
  EXPECT_FALSE(LastSearch(false).search.elapsed.has_value());
  EXPECT_TRUE(LastSearch(true).search.elapsed.has_value());
}

/// A has to run, so that B has to, so that C is closed: three tasks whose change is passed on.
TEST(Search, CountsPropagations) { EXPECT_EQ(LastSearch(false).search.result.propagations, 3U); }

}  // namespace
}  // namespace cbc::search_totals_test
