#include "core/report/run_json.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "core/report/event_json.h"
#include "core/report/run_report.h"
#include "core/report/search_stats.h"
#include "core/support/json.h"

namespace cbc {

void append_failure(std::string& text, const CompiledCatalog& catalog, const Failure& failure) {
  JsonWriter json(text);
  json.open('{');
  json.write_members(
      {{"index", failure.index}, {"line", failure.range.begin.line}, {"message", failure.message}});
  json.write_list("why", failure.unexpected, [&](const UnexpectedTasks& unexpected) {
    write_unexpected(json, catalog, unexpected, *failure.state);
  });
  json.close('}');
}

JsonReport::JsonReport(std::FILE* out, const EventAdditions& adds, bool is_part)
    : out_(out), adds_(adds) {
  if (!is_part) write(R"({"schema":"cbc.solve/1","runs":[)");
}

void JsonReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  catalog_ = &catalog;
  begin_item(is_first_run_, "\n");
  std::string text;
  JsonWriter json(text);
  json.open('{');
  json.write_members({{"catalog", catalog.file}, {"script", script.file}});
  json.open("events", '[');
  json.flush();
  write(text);
  is_first_event_ = true;
  failures_.clear();
}

void JsonReport::on_event(const EventRecord& record, const Step* step, const State& state) {
  begin_item(is_first_event_, "\n ");
  event_.clear();
  append_event(event_, *catalog_, record, step, state, adds_);
  write(event_);
}

void JsonReport::on_failure(const Failure& failure) {
  append_failure(failures_, *catalog_, failure);
}

void JsonReport::end_run(const RunResult& result, const std::string& error) {
  std::string text = "]";
  JsonWriter json(text);
  json.open("expectations", '{');
  json.write_members({{"passed", result.passed}, {"failed", result.failed}});
  json.write_json("failures", "[" + failures_ + "]");
  json.close('}');
  if (result.totals) write_totals(json, *result.totals);
  if (!error.empty()) json.write("error", error);
  json.close('}');
  write(text);
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
  std::string text = "]";
  JsonWriter json(text);
  if (totals_) {
    write_totals(json, *totals_);
    write_process(json, process_usage());
  }
  json.close('}');
  write(text + "\n");
}

void JsonReport::write(std::string_view text) { std::fwrite(text.data(), 1, text.size(), out_); }

void JsonReport::begin_item(bool& is_first, const char* indent) {
  if (!is_first) write(",");
  is_first = false;
  write(indent);
}

}  // namespace cbc
