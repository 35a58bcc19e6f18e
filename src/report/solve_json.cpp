#include "report/solve_json.h"

#include "report/event_json.h"
#include "report/process_usage.h"
#include "report/solve_stats.h"
#include "text/json_text.h"

namespace cbc {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

JsonReport::JsonReport(std::FILE* out, const EventAdditions& adds, bool is_part)
    : out_(out), adds_(adds) {
  if (!is_part) write(R"({"schema":"cbc.solve/1","runs":[)");
}

void JsonReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  catalog_ = &catalog;
  begin_item(is_first_run_, "\n");
  write(R"({"catalog":)" + to_text(catalog.file) + R"(,"script":)" + to_text(script.file) +
        R"(,"events":[)");
  is_first_event_ = true;
  failures_ = Json::array();
}

void JsonReport::on_event(const EventRecord& record, const Step* step, const State& state) {
  begin_item(is_first_event_, "\n ");
  event_.clear();
  append_event(event_, *catalog_, record, step, state, adds_);
  write(event_);
}

void JsonReport::on_failure(const Failure& failure) {
  failures_.push_back(
      {{"index", failure.index}, {"line", failure.range.begin.line}, {"message", failure.message}});
}

void JsonReport::end_run(const RunResult& result, const std::string& error) {
  const Json expectations = {
      {"passed", result.passed}, {"failed", result.failed}, {"failures", failures_}};
  write(R"(],"expectations":)" + to_text(expectations));
  if (result.totals) write(R"(,"totals":)" + to_text(stats_to_json(*result.totals)));
  if (!error.empty()) write(R"(,"error":)" + to_text(error));
  write("}");
  count(result);
}

void JsonReport::count(const RunResult& result) {
  if (!result.totals) return;
  if (!totals_) totals_.emplace();
  totals_->merge(*result.totals);
}

std::unique_ptr<SolveReport> JsonReport::make_part(std::FILE* out) const {
  return std::unique_ptr<SolveReport>(new JsonReport(out, adds_, true));
}

void JsonReport::add_part(std::string_view text, const RunResult& result) {
  if (!is_first_run_) write(",");
  is_first_run_ = false;
  write(text);
  count(result);
}

void JsonReport::end() {
  write("]");
  if (totals_) {
    write(R"(,"totals":)" + to_text(stats_to_json(*totals_)));
    write(R"(,"process":)" + to_text(usage_to_json(process_usage())));
  }
  write("}\n");
}

void JsonReport::write(std::string_view text) { std::fwrite(text.data(), 1, text.size(), out_); }

void JsonReport::begin_item(bool& is_first, const char* indent) {
  if (!is_first) write(",");
  is_first = false;
  write(indent);
}

}  // namespace cbc
