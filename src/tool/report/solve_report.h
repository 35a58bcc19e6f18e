#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "coordinator/state.h"
#include "diagnostic/diagnostic.h"
#include "draw/diagram.h"
#include "draw/catalog_graph.h"
#include "report/event_json.h"
#include "report/sentences.h"
#include "script/runner.h"
#include "script/script.h"
#include "support/json.h"

namespace cbc {

/// A text as content of an element or as value of an attribute in quotes. Line ends stay; other
/// control characters, bytes that are no UTF-8, and characters that XML 1.0 has no place for become
/// printable.
[[nodiscard]] std::string xml_text(std::string_view text);

/// A stream of C that collects in memory what is written to it.
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
  /// What was written so far; valid until more is.
  [[nodiscard]] std::string_view text() {
    if (std::fflush(file_) != 0 || std::ferror(file_) != 0) throw std::bad_alloc();
    return {data_, size_};
  }

 private:
  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* const file_;
};

/// What this process has taken so far.
struct ProcessUsage {
  std::uint64_t peak_memory = 0;  ///< bytes of main memory, at most at one time
  Microseconds cpu_time = 0;      ///< of all threads, and of the system for them
};

[[nodiscard]] ProcessUsage process_usage();

/// What searches took, as a table for a person: for each kind of event that there was, and for all,
/// the number of events, and mean, least and greatest of each measure. Below it what the process
/// took.
[[nodiscard]] std::string stats_table(const SearchTotals& totals, const ProcessUsage& usage,
                                      const Style& style);

/// What one search took, in a line.
[[nodiscard]] std::string stats_line(const SearchRecord& search);

/// Writes the member "totals": the same as the table, without the process. It is {"events",
/// "solutions", "nodes", "propagations", "elapsed_us", "kinds"}. Each measure is {"sum", "mean",
/// "min", "max"}, the last three null where there was no event; each of the kinds that there were
/// has "verb", "origin", and the same measures.
void write_totals(JsonWriter& json, const SearchTotals& totals);

/// Writes the member "process": {"peak_memory_bytes", "cpu_us"}.
void write_process(JsonWriter& json, const ProcessUsage& usage);

/// Microseconds, exact to the nanosecond.
[[nodiscard]] double to_microseconds(std::uint64_t nanoseconds);

/// Is told of all runs of a call, one after the other; what happens in a run comes between its
/// begin and its end. Catalogs and scripts outlive it.
class SolveReport : public RunListener {
 public:
  virtual void begin_run(const CompiledCatalog& catalog, const Script& script) = 0;
  /// `error`: why the run ended early, or empty.
  virtual void end_run(const RunResult& result, const std::string& error) = 0;
  /// After the last run.
  virtual void end() = 0;

  // For runs that are not told one after the other.

  /// A report that is told of one run, on any thread, and writes to `out` what this one would write
  /// of it. Null: this report has to be told of all runs itself.
  [[nodiscard]] virtual std::unique_ptr<SolveReport> make_part(std::FILE* /*out*/) const {
    return nullptr;
  }
  /// Takes, in place of a run, what a part has written of it.
  virtual void add_part(std::string_view /*text*/, const RunResult& /*result*/) {}
};

/// Passes everything on to two reports.
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

/// Which state of a run is asked for: that after an event, or after all that happens by a time;
/// if neither is given, the one at the end.
struct WantedState {
  std::optional<std::uint64_t> index;  ///< of the event; 0: before the first one
  std::optional<Microseconds> time;
};

/// Keeps one state of a run.
class StateRecorder final : public RunListener {
 public:
  /// `catalog` must outlive this object.
  StateRecorder(const CompiledCatalog& catalog, const Script& script, const WantedState& wanted);

  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& /*failure*/) override {}
  void on_end(const State& state) override;

  /// Whether the run has come to the state, however it goes on. A run that came to its end has
  /// passed all of its times.
  [[nodiscard]] bool has_passed() const { return has_passed_; }
  /// How many events there were.
  [[nodiscard]] std::uint64_t events() const { return events_; }
  /// The state that is asked for, or the last one before it.
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

/// Writes a run for a person: a line for each event, below it the changes in the columns of the
/// execution viewer of the paper (P priority, T type, S success), at the end what is active.
class TextReport final : public SolveReport {
 public:
  TextReport(const Style& style, std::FILE* out) : style_(style), out_(out) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& state) override;
  /// An error is told elsewhere.
  void end_run(const RunResult& result, const std::string& error) override;
  /// The sum, if there are several runs, and what searches took, if that was measured.
  void end() override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

 private:
  [[nodiscard]] std::string describe_outcome(const EventRecord& record) const;
  void write_change(const EventRecord& record, const Change& change);
  void write_stopped(const EventRecord& record);
  void write_explanation(const EventRecord& record, const State& state);
  void write_alternatives(const EventRecord& record, const State& state);
  void write(const Sentences& sentences);
  void count(const RunResult& result);

  const Style style_;
  std::FILE* const out_;
  const CompiledCatalog* catalog_ = nullptr;
  std::string script_file_;
  std::size_t behavior_width_ = 0;
  std::size_t task_width_ = 0;
  std::size_t runs_ = 0;
  std::size_t failed_runs_ = 0;
  std::optional<SearchTotals> totals_;
};

/// Writes runs as one JSON document, event by event, so that memory does not grow with the run.
class JsonReport final : public SolveReport {
 public:
  explicit JsonReport(std::FILE* out, const EventAdditions& adds = {})
      : JsonReport(out, adds, false) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& /*state*/) override {}
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
  std::string event_;                   ///< kept for its memory
  std::optional<SearchTotals> totals_;  ///< if time was measured
  std::string failures_;                ///< of the run, as JSON
};

/// Makes one page of all runs, with everything in it: a picture to look at, to step through, to
/// print. Its data are the report in JSON, and of each catalog what the picture needs beyond that.
class HtmlReport final : public SolveReport {
 public:
  HtmlReport() : json_(memory_.stream()) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& state) override;
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

  /// The page, after the end.
  [[nodiscard]] std::string page();

 private:
  MemoryFile memory_;
  JsonReport json_;
  std::vector<const CompiledCatalog*> catalogs_;
  std::string catalogs_json_ = "[";
  std::string runs_json_ = "[";
};

/// Writes failed expectations, and runs that ended early, as workflow commands of GitHub Actions:
/// each becomes an annotation of its line of the script. Nothing is written of what went well.
class GithubReport final : public SolveReport {
 public:
  explicit GithubReport(std::FILE* out) : out_(out) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& /*state*/) override {}
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override {}

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

  /// In place of runs: why there were none, as far as files have errors.
  void add_unreadable(const std::vector<Diagnostic>& findings);

 private:
  std::FILE* const out_;
  std::string script_file_;
  FailureStory story_;
};

/// Writes runs as JUnit XML, of the schema that Jenkins validates with: a script is a test suite,
/// an expectation a test case. A run that ended early is an error, and the expectations it did not
/// come to are skipped. Nothing is said of times: those of a mission are no durations of tests.
class JunitReport final : public SolveReport {
 public:
  explicit JunitReport(std::FILE* out) : JunitReport(out, false) {}

  void begin_run(const CompiledCatalog& catalog, const Script& script) override;
  void on_event(const EventRecord& record, const Step* step, const State& state) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& /*state*/) override {}
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

  [[nodiscard]] std::unique_ptr<SolveReport> make_part(std::FILE* out) const override;
  void add_part(std::string_view text, const RunResult& result) override;

  /// In place of runs: why there were none. Each file with errors is a suite of its own; if there
  /// is none, one suite says that something else is wrong.
  void add_unreadable(const std::vector<Diagnostic>& findings);

 private:
  struct FailedCase {
    const Step* step = nullptr;
    std::string message;
    std::string details;  ///< as XML
  };

  JunitReport(std::FILE* out, bool is_part);
  void write_cases(const RunResult& result) const;
  void write_broken_suite(const std::string& file, const std::string& message,
                          const std::string& details) const;

  std::FILE* const out_;
  const CompiledCatalog* catalog_ = nullptr;
  const Script* script_ = nullptr;
  FailureStory story_;
  std::vector<FailedCase> failed_;  ///< in the order of the script
};

}  // namespace cbc
