#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "catalog/situation.h"
#include "page_files.h"
#include "report/catalog_report.h"
#include "report/sentences.h"
#include "report/solve_report.h"
#include "script/event_lines.h"
#include "support/json.h"

namespace cbc {
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
  JsonWriter json(failures_);
  json.open('{');
  json.write_members(
      {{"index", failure.index}, {"line", failure.range.begin.line}, {"message", failure.message}});
  json.write_list("why", failure.surprises, [&](const Surprise& surprise) {
    write_surprise(json, *catalog_, surprise, *failure.state);
  });
  json.close('}');
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

namespace {

std::vector<draw::RunState::RunningTask> running_tasks(const CompiledCatalog& catalog,
                                                       const State& state) {
  std::vector<draw::RunState::RunningTask> running;
  for (const std::uint32_t index : state.running()) {
    const TaskId task = catalog.task_ids[index];
    auto& one = running.emplace_back();
    one.task = index;
    one.behavior = catalog.behaviors[state.behavior(task)].catalog_index;
    if (state.has_request(task)) one.priority = state.request(task).priority;
  }
  return running;
}

/// The event, with its outcome if it has one. Parameters are left out: they may be long.
std::string describe(const CompiledCatalog& catalog, const EventRecord& record) {
  std::string text = describe_event(catalog, record, nullptr);
  if (form_of(record.verb).is_decided) text += ": " + std::string(name_of(record.outcome));
  return text;
}

}  // namespace

StateRecorder::StateRecorder(const CompiledCatalog& catalog, const Script& script,
                             const WantedState& wanted)
    : catalog_(catalog), wanted_(wanted) {
  moment_.script = script.file;
  has_passed_ = wanted.index == 0;
  State state(catalog);
  state.change_situation(script.situation.availability, script.situation.variables);
  note_behaviors(state);
}

void StateRecorder::note_behaviors(const State& state) {
  state_.unavailable.clear();
  state_.misfits.clear();
  state_.faulty.clear();
  for (std::uint32_t index = 0; index < catalog_.behavior_ids.size(); ++index) {
    const BehaviorId behavior = catalog_.behavior_ids[index];
    if (state.is_denied(behavior)) {
      state_.unavailable.push_back(index);
    } else if (const auto variable = catalog_.find_misfit(behavior, state.variables())) {
      const VariableValue value{*variable, state.value_of(*variable)};
      state_.misfits.push_back({index, describe_value(catalog_, value)});
    }
    if (state.is_faulty(behavior)) state_.faulty.push_back(index);
  }
  moment_.situation.clear();
  for (std::uint32_t variable = 0; variable < catalog_.variables.size(); ++variable) {
    if (variable > 0) moment_.situation += ", ";
    moment_.situation += describe_value(catalog_, {variable, state.value_of(variable)});
  }
}

void StateRecorder::on_event(const EventRecord& record, const Step* /*step*/, const State& state) {
  events_ = record.index;
  has_passed_ |= wanted_.time && record.time > *wanted_.time;
  if (has_passed_) return;
  has_passed_ = record.index == wanted_.index;
  moment_.index = record.index;
  moment_.time = record.time;
  moment_.event = describe(catalog_, record);
  state_.before = std::exchange(state_.running, running_tasks(catalog_, state));
  state_.finished.reset();
  if (record.verb == Verb::finish && record.outcome == Outcome::accepted) {
    state_.finished = catalog_.behaviors[record.behavior].catalog_index;
  }
  state_.changes.clear();
  for (const Change& change : record.changes) {
    state_.changes.push_back({catalog_.behaviors[change.behavior].catalog_index,
                              change.is_activation, change.success,
                              change.cause == ChangeCause::undone});
  }
  // This takes time in proportion to the catalog, so only for states that may be the selected one.
  if (has_passed_ || wanted_.time) note_behaviors(state);
}

void StateRecorder::on_end(const State& state) {
  if (!has_passed_) note_behaviors(state);
}

namespace {

constexpr double one_percent = one_million / 100.0;

/// What the picture needs of a catalog: tasks, situation variables and behaviors in catalog order,
/// suitabilities in percent.
void write_catalog(JsonWriter& json, const CompiledCatalog& catalog) {
  const auto write_task = [&](TaskId task) { json.write(catalog.name_of_task(task)); };
  json.open('{');
  json.write_list("tasks", catalog.task_names);
  json.open("variables", '[');
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    write_variable(json, catalog, variable);
  }
  json.close(']');
  json.write_list("behaviors", catalog.behavior_ids, [&](BehaviorId behavior) {
    json.open('{');
    json.write("name", catalog.name_of_behavior(behavior));
    json.write_list("performs", catalog.performs[behavior], [&](ValueId value) {
      json.write_object({{"task", catalog.name_of_task(catalog.task_of(value))},
                         {"suitability", catalog.values.items[value].suitability / one_percent}});
    });
    json.write_list("requires", catalog.requirements[behavior],
                    [&](const CompiledRequirement& required) { write_task(required.task); });
    write_conditions(json, conditions_of(catalog, behavior));
    json.close('}');
  });
  json.open("exclusive", '[');
  for (std::size_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    json.open('[');
    for (const TaskId task : catalog.cliques[clique]) write_task(task);
    json.close(']');
  }
  json.close(']');
  json.close('}');
}

/// Failed expectations that a full page has of a run: their messages stand without their events.
constexpr std::uint64_t most_later_failures = 100;

/// Adds JSON to a script element, which ends at the first "</script" wherever it is, and is parsed
/// differently after "<!--". In JSON, "<" occurs in strings only.
void add_to_script_element(std::string& text, std::string_view json) {
  for (const char character : json) {
    if (character == '<') {
      text += "\\u003c";
    } else {
      text += character;
    }
  }
}

}  // namespace

void HtmlReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  auto place = std::find(catalogs_.begin(), catalogs_.end(), &catalog);
  if (place == catalogs_.end()) {
    JsonWriter json(catalogs_json_);
    write_catalog(json, catalog);
    place = catalogs_.insert(place, &catalog);
  }
  JsonWriter json(runs_json_);
  json.open('{');
  json.write("catalog", place - catalogs_.begin());
  write_situation(json, catalog, script.situation);
  json.flush();
  json_.begin_run(catalog, script);
  left_out_of_run_ = 0;
  failures_left_ = most_later_failures;
}

void HtmlReport::on_event(const EventRecord& record, const Step* step, const State& state) {
  if (is_full()) {
    ++left_out_of_run_;
  } else {
    json_.on_event(record, step, state);
  }
}

void HtmlReport::on_failure(const Failure& failure) {
  if (left_out_of_run_ == 0) return json_.on_failure(failure);
  if (failures_left_ == 0) return;
  --failures_left_;
  json_.on_failure(failure);
}

void HtmlReport::on_end(const State& state) { json_.on_end(state); }

void HtmlReport::end_run(const RunResult& result, const std::string& error) {
  json_.end_run(result, error);
  JsonWriter json(runs_json_);
  json.write("left_out", left_out_of_run_);
  json.close('}');
  left_out_ += left_out_of_run_;
}

void HtmlReport::end() { json_.end(); }

std::string HtmlReport::page() {
  std::string page;
  page.reserve(memory_.size() + memory_.size() / 8);
  for (const std::string_view part : page_before_data) page += part;
  for (const std::string_view data :
       {std::string_view(R"({"catalogs":)"), std::string_view(catalogs_json_),
        std::string_view(R"(],"runs":)"), std::string_view(runs_json_),
        std::string_view(R"(],"report":)"), memory_.text(), std::string_view("}")}) {
    add_to_script_element(page, data);
  }
  for (const std::string_view part : page_after_data) page += part;
  return page;
}

}  // namespace cbc
