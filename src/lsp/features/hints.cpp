#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/support/wording.h"
#include "core/words/failure_explanation.h"
#include "core/words/layout.h"
#include "core/words/reason_words.h"
#include "core/yaml/source.h"
#include "lsp/features/features.h"
#include "runtime/base/text.h"

namespace cbc::lsp {
namespace {

using Clock = std::chrono::steady_clock;

/// A mission that takes longer has no hints after that.
constexpr auto longest_run = std::chrono::milliseconds(200);
constexpr std::size_t most_events = 4;    // in one hint
constexpr std::size_t most_changes = 6;   // of one event
constexpr std::size_t most_columns = 96;  // of what is said of one event
constexpr std::size_t most_lines = 20;    // on hover

/// By line of the script, what happens there.
class HintedRun final : public RunListener {
 public:
  struct Hint {
    std::string label;
    std::string reason;      ///< on hover
    std::size_t events = 0;  ///< of which only the first ones are in the label
  };

  HintedRun(const CompiledCatalog& catalog, const Script& script) : catalog_(catalog) {
    explanation_.begin_run(catalog, script);
  }

  void on_event(const ExplainedRecord& record, const Step* step, const State& state) override {
    explanation_.add(record, step, state);
    if (step != nullptr) present_ = &hints_[step->range.begin];
    if (present_ == nullptr) return;
    std::string words = step == nullptr ? std::string("then") : std::string();
    const bool is_rejected = record.outcome == Outcome::rejected;
    if (step != nullptr && is_rejected) {
      words = "rejected";
      present_->reason = tooltip(describe_rejection(catalog_, record));
    }
    std::size_t count = 0;
    std::string changes;
    for (const cbc::Change& change : record.changes) {
      if (++count > most_changes) continue;
      changes +=
          concat(changes.empty() ? "" : " ", change.is_activation ? "+" : "−",
                 catalog_.name_of_behavior(change.behavior), change.success ? "" : " (fails)");
    }
    if (count > most_changes) changes += concat(" and ", count - most_changes, " more");
    if ((step == nullptr && changes.empty()) || ++present_->events > most_events) return;
    if (!changes.empty()) words += concat(words.empty() ? "" : " ", changes);
    if (words.empty()) words = "no change";
    present_->label += concat(present_->label.empty() ? "" : "; ", shorten(words, most_columns));
  }

  void on_success(const Success& success) override { hints_[success.step.range.begin].label = "✓"; }

  void on_failure(const Failure& failure) override {
    Hint& hint = hints_[failure.range.begin];
    hint.label = concat("✗ ", shorten(failure.message, most_columns));
    std::vector<std::string> lines = explanation_.tell(failure);
    lines.insert(lines.begin(), failure.message);
    hint.reason = tooltip(std::move(lines));
  }

  [[nodiscard]] const std::map<Position, Hint>& hints() const { return hints_; }

 private:
  static std::string tooltip(std::vector<std::string> lines) {
    if (lines.size() > most_lines) {
      const std::size_t more = lines.size() - most_lines;
      lines.resize(most_lines);
      lines.push_back(concat("and ", quantity(more, "more line")));
    }
    return join(lines, "\n");
  }

  const CompiledCatalog& catalog_;
  FailureExplanation explanation_;
  std::map<Position, Hint> hints_;
  Hint* present_ = nullptr;
};

}  // namespace

Json list_hints(const Workspace& workspace, const File& file, std::size_t begin, std::size_t end) {
  Json hints = Json::array();
  const File* const catalog = workspace.catalog_of(file);
  if (file.kind != cli::FileKind::script || catalog == nullptr || catalog->checked == nullptr ||
      catalog->checked->compiled == nullptr || file.input->document == nullptr) {
    return hints;
  }
  Diagnostics ignored;
  const CompiledCatalog& compiled = *catalog->checked->compiled;
  const auto script = read_script(*file.input->document, compiled, Severity::warning, ignored);
  if (!script) return hints;
  const Clock::time_point deadline = Clock::now() + longest_run;
  CoordinatorOptions options;
  options.is_stopped = [deadline] { return Clock::now() >= deadline; };
  options.search.is_stopped = options.is_stopped;
  HintedRun run(compiled, *script);
  Runner runner(compiled, options_of(*script, options), run,
                {.rejections = true, .failures = true});
  runner.begin(script->situation);
  for (const Step& step : script->steps) {
    if (options.is_stopped() || !runner.take(step)) break;
  }
  for (const auto& [place, hint] : run.hints()) {
    const std::size_t from = file.text->offset_of(place);
    if (from < begin || from > end) continue;
    std::size_t at = yaml::end_of_line(file.text->content(), from);
    if (at > from && file.text->content()[at - 1] == '\r') --at;
    std::string label = hint.label;
    if (hint.events > most_events) label += concat("; and ", hint.events - most_events, " more");
    Json entry = {
        {"position", to_json(file.text->place_of(at))}, {"label", label}, {"paddingLeft", true}};
    if (!hint.reason.empty()) entry["tooltip"] = hint.reason;
    hints.push_back(std::move(entry));
  }
  return hints;
}

}  // namespace cbc::lsp
