#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "cbc/event.h"
#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/state.h"
#include "diagnostic/diagnostic.h"
#include "draw/catalog_graph.h"
#include "draw/diagram.h"
#include "report/failure_story.h"
#include "report/run_summary.h"
#include "script/runner.h"
#include "script/script.h"
#include "support/json.h"
#include "sweep/sweep.h"

// The reports of `cbc solve`: of runs, of event streams, and of sweeps.

namespace cbc {

/// Escapes a text as content of an XML element or as a quoted attribute value. Line ends are kept;
/// other control characters, invalid UTF-8 and characters that XML 1.0 does not allow become
/// printable.
[[nodiscard]] std::string xml_text(std::string_view text);

/// A C stream that writes to memory.
class MemoryFile {
 public:
  MemoryFile() : file_(open_memstream(&data_, &size_)) {
    if (file_ == nullptr) throw std::bad_alloc();
  }
  ~MemoryFile() {
    std::fclose(file_);
    std::free(data_);  // NOLINT(cppcoreguidelines-no-malloc): open_memstream wants it
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::FILE* stream() { return file_; }
  /// How much was written so far.
  [[nodiscard]] std::size_t size() { return static_cast<std::size_t>(std::ftell(file_)); }
  /// What was written so far; valid until the next write.
  [[nodiscard]] std::string_view text() {
    if (std::fflush(file_) != 0 || std::ferror(file_) != 0) throw std::bad_alloc();
    return {data_, size_};
  }

 private:
  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* const file_;
};

/// The resources that this process has used so far.
struct ProcessUsage {
  std::uint64_t peak_memory = 0;  ///< bytes of main memory, at its peak
  Microseconds cpu_time = 0;      ///< of all threads, user and system
};

[[nodiscard]] ProcessUsage process_usage();

/// The effort of searches as a table for people: for each kind of event that occurred, and for all,
/// the number of events and the mean, minimum and maximum of each measure; below it the resources
/// of the process.
[[nodiscard]] std::string stats_table(const SearchTotals& totals, const ProcessUsage& usage,
                                      const Style& style);

/// The effort of one search, in one line.
[[nodiscard]] std::string stats_line(const SearchRecord& search);

/// Writes one of the reasons of a conflict set, as an object.
void write_reason(JsonWriter& json, const CompiledCatalog& catalog, const EventRecord& record,
                  const Reason& reason);

/// Writes why tasks are not as expected, as an object.
void write_surprise(JsonWriter& json, const CompiledCatalog& catalog, const Surprise& surprise,
                    const State& state);

/// Writes the member "totals", the same numbers as the table: {"events", "solutions", "nodes",
/// "propagations", "elapsed_us", "kinds"}. Each measure is {"sum", "mean", "min", "max"}, the last
/// three null if there was no event. Each kind that occurred has "verb", "origin" and the same
/// measures.
void write_totals(JsonWriter& json, const SearchTotals& totals);

/// Writes the member "process": {"peak_memory_bytes", "cpu_us"}.
void write_process(JsonWriter& json, const ProcessUsage& usage);

/// Microseconds, exact to the nanosecond.
[[nodiscard]] double to_microseconds(std::uint64_t nanoseconds);

/// The optional keys of events.
struct EventAdditions {
  bool why = false;
  bool alternatives = false;
  bool note = false;  ///< for the page alone: see describe_note
};

/// Appends an expectation that failed, as an object.
void append_failure(std::string& text, const CompiledCatalog& catalog, const Failure& failure);

/// Appends one event as JSON on one line, as in cbc.solve/1. `step` is the scripted one, or null.
/// No tree is built: streams write a hundred thousand events per second.
void append_event(std::string& text, const CompiledCatalog& catalog, const EventRecord& record,
                  const Step* step, const State& state, const EventAdditions& adds);

// The lines of an event stream (schema cbc.events/1), each with its line end.

/// `catalog_name`: the path of the catalog as the user gave it. `variables`: the values of the
/// situation variables. Of the options a replay needs those that a script sets. `clock`: the
/// word of the option; empty where a log has none.
[[nodiscard]] std::string stream_header(const CompiledCatalog& catalog,
                                        std::string_view catalog_name,
                                        const CoordinatorOptions& options,
                                        const Situation& situation,
                                        std::span<const std::uint32_t> variables,
                                        std::string_view clock);
/// The answer to an input line that is not an event.
[[nodiscard]] std::string stream_error(std::string_view message, std::uint64_t line);

/// The last line of a stream with statistics: the effort of all searches and of the process so far.
[[nodiscard]] std::string stream_totals(const SearchTotals& totals);

/// Passes on each event as a line as soon as it is solved.
class EventStream final : public RunListener {
 public:
  /// A line with its end, and what it is about.
  struct Line {
    std::string_view text;
    const EventRecord& record;
    const State& state;  ///< after the event
  };
  using TakeLine = std::function<void(const Line&)>;
  using TakeFailure = std::function<void(const Failure&)>;

  /// The catalog must outlive this object.
  EventStream(const CompiledCatalog& catalog, const EventAdditions& adds, TakeLine take_line,
              TakeFailure take_failure)
      : catalog_(catalog),
        adds_(adds),
        take_line_(std::move(take_line)),
        take_failure_(std::move(take_failure)) {}

  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override { take_failure_(failure); }

 private:
  const CompiledCatalog& catalog_;
  const EventAdditions adds_;
  TakeLine take_line_;
  TakeFailure take_failure_;
  std::string line_;  ///< kept for its memory
};

/// Receives all runs of a call, one after the other: for each run begin_run, its events, end_run.
/// Catalogs and scripts must outlive it.
class SolveReport : public RunListener {
 public:
  virtual void begin_run(const CompiledCatalog& catalog, const Script& script) = 0;
  /// `error`: why the run ended early, or empty.
  virtual void end_run(const RunResult& result, const std::string& error) = 0;
  /// After the last run.
  virtual void end() {}

  // For runs in parallel.

  /// A report for one run, on any thread, which writes to `out` what this one would write. Null:
  /// this report must receive all runs itself.
  [[nodiscard]] virtual std::unique_ptr<SolveReport> make_part(std::FILE* /*out*/) const {
    return nullptr;
  }
  /// Adds what a part has written, in place of its run.
  virtual void add_part(std::string_view /*text*/, const RunResult& /*result*/) {}
};

/// Forwards everything to two reports.
class ReportPair final : public SolveReport {
 public:
  ReportPair(SolveReport& one, SolveReport& other) : first_(one), second_(other) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override {
    first_.begin_run(catalog, script);
    second_.begin_run(catalog, script);
  }
  void on_event(const EventRecord& record, const Step* step, const State& state) override {
    first_.on_event(record, step, state);
    second_.on_event(record, step, state);
  }
  void on_failure(const Failure& failure) override {
    first_.on_failure(failure);
    second_.on_failure(failure);
  }
  void on_end(const State& state) override {
    first_.on_end(state);
    second_.on_end(state);
  }
  void end_run(const RunResult& result, const std::string& error) override {
    first_.end_run(result, error);
    second_.end_run(result, error);
  }
  void end() override {
    first_.end();
    second_.end();
  }

 private:
  SolveReport& first_;
  SolveReport& second_;
};

/// Selects a state of a run: the one after an event, after all events up to a time, or, if neither
/// is given, at the end.
struct WantedState {
  std::optional<std::uint64_t> index;  ///< of the event; 0: before the first one
  std::optional<Microseconds> time;
};

/// Records the selected state of a run.
class StateRecorder final : public RunListener {
 public:
  /// `catalog` must outlive this object.
  StateRecorder(const CompiledCatalog& catalog, const Script& script, const WantedState& wanted);

  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_end(const State& state) override;

  /// Whether the run has reached the state. A run that reached its end has passed all times.
  [[nodiscard]] bool has_passed() const { return has_passed_; }
  /// Number of events so far.
  [[nodiscard]] std::uint64_t events() const { return events_; }
  /// The selected state, or the last one before it.
  [[nodiscard]] const draw::RunState& state() const { return state_; }
  [[nodiscard]] const draw::Moment& moment() const { return moment_; }

 private:
  void note_behaviors(const State& state);

  const CompiledCatalog& catalog_;
  const WantedState wanted_;
  draw::RunState state_;
  draw::Moment moment_;
  std::uint64_t events_ = 0;
  bool has_passed_ = false;
};

/// The form of a text about runs.
struct TextLayout {
  std::size_t columns = 0;  ///< lines are wrapped to so many; 0: not at all
  bool is_brief = false;    ///< an event is one line
};

/// Writes a run for people: a line for each event, below it the changes with the columns of the
/// execution viewer in the paper (P priority, T type, S success); at the end the active behaviors
/// and a summary.
class TextReport final : public SolveReport {
 public:
  TextReport(const Style& style, std::FILE* out, const TextLayout& layout = {})
      : style_(style), layout_(layout), out_(out) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& state) override;
  /// Errors go to standard error, not here.
  void end_run(const RunResult& result, const std::string& error) override;
  /// Writes the totals: of several runs, and of searches if they were measured.
  void end() override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

 private:
  [[nodiscard]] std::string describe_outcome(const EventRecord& record, const State& state) const;
  [[nodiscard]] std::string describe_briefly(const EventRecord& record) const;
  void write_details(const EventRecord& record, const State& state);
  void write_change(const EventRecord& record, const Change& change);
  void write_failed(const EventRecord& record);
  void write_stopped(const EventRecord& record);
  void write_explanation(const EventRecord& record, const State& state);
  void write_alternatives(const EventRecord& record, const State& state);
  void write(const Sentences& sentences);
  void write(const std::vector<SummaryLine>& lines);
  /// Wraps the line; what follows the first break is indented by `indent` columns.
  void write_line(const std::string& line, std::size_t indent);
  void count(const RunResult& result);

  const Style style_;
  const TextLayout layout_;
  std::FILE* const out_;
  const CompiledCatalog* catalog_ = nullptr;
  FailureStory story_;
  RunSummary summary_;
  ScriptTable scripts_;
  std::string script_file_;
  std::size_t behavior_width_ = 0;
  std::size_t task_width_ = 0;
  std::size_t runs_ = 0;
  std::size_t failed_runs_ = 0;
  std::optional<SearchTotals> totals_;
};

/// Writes runs as one JSON document, event by event: memory does not grow with the run.
class JsonReport final : public SolveReport {
 public:
  explicit JsonReport(std::FILE* out, const EventAdditions& adds = {})
      : JsonReport(out, adds, false) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

 private:
  JsonReport(std::FILE* out, const EventAdditions& adds, bool is_part);
  void count(const RunResult& result);
  void write(std::string_view text);
  void begin_item(bool& is_first, const char* indent);

  std::FILE* const out_;
  const EventAdditions adds_;
  const CompiledCatalog* catalog_ = nullptr;
  bool is_first_run_ = true;
  bool is_first_event_ = true;
  std::string event_;                   ///< reused, to save allocations
  std::optional<SearchTotals> totals_;  ///< if time was measured
  std::string failures_;                ///< of the run, as JSON
};

/// A property, as a page lists it.
struct PropertyOfPage {
  std::string title;        ///< where it is, and its name: "robot.yaml:5: landing is possible"
  std::string statement;    ///< what it says
  std::string_view result;  ///< the word for it: "proved"
  std::string description;  ///< the result in a sentence, with how far it reaches
  bool has_run = false;     ///< whether the page has its counterexample or witness
};

/// Makes a self-contained HTML page of all runs: a timeline to step through or to print. Its data
/// are the JSON report and what the picture needs of each catalog beyond that. Events that no
/// longer fit are left out, which the page says: no browser shows it otherwise, and memory stays
/// bounded.
class HtmlReport final : public SolveReport {
 public:
  static constexpr std::size_t most_data = std::size_t{32} << 20;  ///< in bytes of the report

  explicit HtmlReport(const EventAdditions& adds = {}, std::size_t limit = most_data)
      : json_(memory_.stream(), {adds.why, adds.alternatives, true}), limit_(limit) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& state) override;
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

  /// Makes it a page of properties: the runs are those of the properties that have one, in their
  /// order. The page shows the last event of a run first: that is what its script leads to.
  void list_properties(const std::vector<PropertyOfPage>& properties);

  /// The page; call it after end().
  [[nodiscard]] std::string page();

  /// How many events of all runs are not on the page.
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

 private:
  [[nodiscard]] bool is_full() { return memory_.size() >= limit_; }

  MemoryFile memory_;
  JsonReport json_;
  const std::size_t limit_;
  std::uint64_t left_out_ = 0;
  std::uint64_t left_out_of_run_ = 0;
  std::uint64_t failures_left_ = 0;  ///< of the run, that are taken although the page is full
  std::vector<const CompiledCatalog*> catalogs_;
  std::string catalogs_json_ = "[";
  std::string runs_json_ = "[";
  std::string properties_json_;  ///< a member of the data, if it is a page of properties
};

/// Writes failed expectations and runs that ended early as workflow commands of GitHub Actions:
/// each becomes an annotation of its line in the script. Nothing is written about successes.
class GithubReport final : public SolveReport {
 public:
  explicit GithubReport(std::FILE* out) : out_(out) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void end_run(const RunResult& result, const std::string& error) override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

  /// Writes the errors of files that could not be read, in place of runs.
  static void report_unreadable(std::FILE* out, const std::vector<Diagnostic>& findings);

 private:
  std::FILE* const out_;
  std::string script_file_;
  FailureStory story_;
};

/// Writes runs as JUnit XML (the schema that Jenkins validates with): a script is a test suite, an
/// expectation a test case. A run that ended early is an error, and the expectations it did not
/// reach are skipped. There are no times: those of a mission are not durations of tests.
class JunitReport final : public SolveReport {
 public:
  explicit JunitReport(std::FILE* out) : JunitReport(out, false) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

  /// Writes why there were no runs. Each file with errors is a suite; if there is none, one suite
  /// says that something else is wrong.
  static void report_unreadable(std::FILE* out, const std::vector<Diagnostic>& findings);

 private:
  struct FailedCase {
    const Step* step = nullptr;
    std::string message;
    std::string details;  ///< as XML
  };

  JunitReport(std::FILE* out, bool is_part);
  void write_cases(const RunResult& result) const;
  std::FILE* const out_;
  const CompiledCatalog* catalog_ = nullptr;
  const Script* script_ = nullptr;
  FailureStory story_;
  std::vector<FailedCase> failed_;  ///< in the order of the script
};

/// What a report depends on besides the runs.
struct ReportSettings {
  std::FILE* out = stdout;
  Style style = plain_style();  ///< of a text for people
  EventAdditions adds;          ///< of a report for programs
  TextLayout layout;            ///< of a text for people
};

/// A format of `cbc solve` for whole runs. Event streams (jsonl) are not among them.
struct SolveFormat {
  std::string_view name;
  std::unique_ptr<SolveReport> (*make)(const ReportSettings& settings);
  /// Writes why there are no runs, in place of a report. Null: nothing is written then.
  void (*report_unreadable)(std::FILE* out, const std::vector<Diagnostic>& findings) = nullptr;
};

/// The first one is the default.
[[nodiscard]] std::span<const SolveFormat> solve_formats();

/// The result of a sweep, schema cbc.sweep/1; "stats" is there if the result has times.
///
///   sequences, seed, options, shard   what was run; {"index": 1, "count": 1} is a whole sweep
///   digest         of the compiled catalog without the name of its file
///   events         by kind, in this order, how many had which outcome; "escalated" counts the
///                  accepted ones at a protection level above the first
///   tasks          in catalog order: start events of scripts that were accepted ("started") or
///                  rejected, and how often the task started to run, for whatever reason ("runs")
///   behaviors      in catalog order: activations that succeeded (but for undone ones) and failed
///   never_ran, never_active    the tasks, the behaviors with none of these
///   reasons        in how many rejections each reason had a part, whatever the priorities; the
///                  members are those of "conflict" of cbc.solve/1
///   nodes          of the events that took a search: median (p50), 99th percentile and maximum;
///                  histogram: [number, count], numbers from 1024 on rounded down to 10 binary
///                  digits, as are the percentiles then
///   slowest        the first event with the most nodes, and a script to reproduce it, or null;
///                  sequence and event count from 1
///   stats          elapsed time, summed over shards [µs]; times of the events that took a search,
///                  and the slowest of them [ns]
[[nodiscard]] std::string sweep_to_json(const SweepResult& result);

/// Reads what sweep_to_json wrote. Whatever the text, the result may be merged and reported; if it
/// cannot be understood, the second alternative says why, for people.
[[nodiscard]] std::variant<SweepResult, std::string> sweep_from_json(std::string_view text);

/// The result of a sweep for people.
[[nodiscard]] std::string sweep_to_text(const SweepResult& result, const Style& style);

/// A format of `cbc solve --sweep`.
struct SweepFormat {
  std::string_view name;
  std::string (*write)(const SweepResult& result, const Style& style);
};

/// The first one is the default.
[[nodiscard]] std::span<const SweepFormat> sweep_formats();

}  // namespace cbc
