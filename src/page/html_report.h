#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "core/report/run_json.h"
#include "core/report/run_report.h"
#include "core/support/system.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"

namespace cbc {

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
  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override;
  void on_success(const Success& success) override;
  void on_failure(const Failure& failure) override;
  void on_end(const State& state) override;
  void end_run(const RunResult& result, const std::string& error) override;
  void end() override;

  /// Lets the runs go on in the simulator, a page in a file: gives this page the texts of catalogs
  /// and missions, as long as all of them are not too long. Call it before the first run.
  /// `text_of`: the text of a catalog in YAML, which lives as long as this object; null if it is
  /// not known.
  void continue_in(const std::string& simulator,
                   std::function<const std::string*(const CompiledCatalog&)> text_of);

  /// Makes it a page of properties: the runs are those of the properties that have one, in their
  /// order. The page shows the last event of a run first: that is what its script leads to.
  void list_properties(const std::vector<PropertyOfPage>& properties);

  /// The page; call it after end().
  [[nodiscard]] std::string page();

  /// How many events of all runs are not on the page.
  [[nodiscard]] std::uint64_t left_out() const { return left_out_; }

 private:
  [[nodiscard]] bool is_full() { return memory_.size() >= limit_; }
  void add_catalog(const CompiledCatalog& catalog);
  /// Whether there is room for a further text that goes to the simulator; if so, it is taken.
  [[nodiscard]] bool takes_text(std::size_t size);

  MemoryFile memory_;
  JsonReport json_;
  const std::size_t limit_;
  std::uint64_t left_out_ = 0;
  std::uint64_t left_out_of_run_ = 0;
  std::uint64_t failures_left_ = 0;  ///< of the run, that are taken although the page is full
  std::vector<const CompiledCatalog*> catalogs_;
  std::vector<bool> have_text_;  ///< of these: the page has their texts
  std::string catalogs_json_ = "[";
  std::string runs_json_ = "[";
  std::string properties_json_;  ///< a member of the data, if it is a page of properties
  std::string simulator_json_;   ///< another one, if runs may go on there
  std::function<const std::string*(const CompiledCatalog&)> text_of_;
  std::size_t text_size_ = 0;  ///< of all texts for the simulator
};

/// What the page has to know about a catalog, as JSON on one line: tasks, situation variables and
/// behaviors in catalog order, suitabilities in percent.
[[nodiscard]] std::string catalog_of_page(const CompiledCatalog& catalog);

/// A stream of events, or its end, as the HTML page gets it: the page is that of HtmlReport.
struct StreamOfPage {
  std::string name;            ///< of the stream
  std::string begin;           ///< the state before it, see state_of_page()
  std::string events;          ///< as in cbc.events/1, separated by commas
  std::uint64_t left_out = 0;  ///< events after these, which do not fit on a page
  /// If it is not empty, the page gets further events from "events?run=TOKEN", relative to itself.
  std::string token;
};

[[nodiscard]] std::string stream_page(const CompiledCatalog& catalog, const StreamOfPage& stream);

/// What the page has to know about a state to show the events after it, as JSON on one line:
///
///   index, time    of the last event before
///   running, requests, queue    as in an event of cbc.solve/1
///   situation      the values of all variables, and the behaviors that are not available
///   faulty         behaviors
[[nodiscard]] std::string state_of_page(const CompiledCatalog& catalog, std::uint64_t index,
                                        Microseconds time, const State& state);

}  // namespace cbc
