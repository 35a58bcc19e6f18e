#include "page/html_report.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/catalog/situation.h"
#include "core/compile/catalog_json.h"
#include "core/report/event_description.h"
#include "core/script/script.h"
#include "core/script/state_json.h"
#include "core/support/json.h"
#include "core/support/wording.h"
#include "page/script_element.h"
#include "page_files.h"

namespace cbc {

std::string catalog_of_page(const CompiledCatalog& catalog) {
  std::string text;
  JsonWriter json(text);
  const auto write_task = [&](TaskId task) { json.write(catalog.name_of_task(task)); };
  json.open('{');
  json.write_list("tasks", catalog.task_names);
  json.write("supporting",
             std::count_if(catalog.tasks.begin(), catalog.tasks.end(),
                           [](const CompiledTask& task) { return task.start_on_request == 0; }));
  json.open("variables", '[');
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    json.begin_item();
    json::variable_with_values.write(json, variable, catalog);
  }
  json.close(']');
  json.write_list("behaviors", catalog.behavior_ids, [&](BehaviorId behavior) {
    json.open('{');
    json.write("name", catalog.name_of_behavior(behavior));
    json.write_list("performs", catalog.performs[behavior], [&](ValueId value) {
      json.write_object({{"task", catalog.name_of_task(catalog.task_of(value))},
                         {"suitability", in_percent(catalog.values.items[value].suitability)}});
    });
    json.write_list("requires", catalog.requirements[behavior],
                    [&](const CompiledRequirement& required) { write_task(required.task); });
    json.key("situation");
    json::conditions.write(json, json::by_variable(conditions_of(catalog, behavior)), catalog);
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
  json.flush();
  return text;
}

namespace {

/// Failed expectations that a full page has of a run: their messages stand without their events.
constexpr std::uint64_t most_later_failures = 100;

/// `data`: in parts. `sources`: what the page may connect to, for its security policy.
std::string make_page(std::initializer_list<std::string_view> data, std::string_view sources) {
  std::string page(page_before_sources);
  page += sources;
  for (const std::string_view part : page_before_data) page += part;
  for (const std::string_view part : data) add_to_script_element(page, part);
  for (const std::string_view part : page_after_data) page += part;
  return page;
}

}  // namespace

void HtmlReport::continue_in(const std::string& simulator,
                             std::function<const std::string*(const CompiledCatalog&)> text_of) {
  text_of_ = std::move(text_of);
  simulator_json_ = R"(,"simulator":)";
  append_text(simulator_json_, "file://" + percent_encode(simulator));
}

bool HtmlReport::takes_text(std::size_t size) {
  // A catalog and a mission go into one address, which browsers take up to 2 MB.
  constexpr std::size_t most_of_one = std::size_t{1} << 19;
  constexpr std::size_t most_of_all = std::size_t{1} << 23;
  if (size > most_of_one || text_size_ + size > most_of_all) return false;
  text_size_ += size;
  return true;
}

void HtmlReport::add_catalog(const CompiledCatalog& catalog) {
  if (!catalogs_.empty()) catalogs_json_ += ',';
  catalogs_json_ += catalog_of_page(catalog);
  catalogs_.push_back(&catalog);
  const std::string* const text = text_of_ ? text_of_(catalog) : nullptr;
  const bool has_text = text != nullptr && takes_text(text->size());
  have_text_.push_back(has_text);
  if (!has_text) return;
  catalogs_json_.pop_back();
  catalogs_json_ += R"(,"text":)";
  append_text(catalogs_json_, *text);
  catalogs_json_ += '}';
}

void HtmlReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  const auto found = std::find(catalogs_.begin(), catalogs_.end(), &catalog);
  const auto place = static_cast<std::size_t>(found - catalogs_.begin());
  if (found == catalogs_.end()) add_catalog(catalog);
  JsonWriter json(runs_json_);
  json.open('{');
  json.write("catalog", place);
  if (have_text_[place] && !script.steps.empty()) {
    const std::string mission = write_script(catalog, script, "");
    if (takes_text(mission.size())) json.write("mission", mission);
  }
  json.key("situation");
  json::situation.write(json, json::entries_of(script.situation, catalog), catalog);
  json.flush();
  json_.begin_run(catalog, script);
  left_out_of_run_ = 0;
  failures_left_ = most_later_failures;
}

void HtmlReport::on_event(const ExplainedRecord& record, const Step* step, const State& state) {
  if (is_full()) {
    ++left_out_of_run_;
    json_.leave_out(record, step, state);
  } else {
    json_.on_event(record, step, state);
  }
}

void HtmlReport::on_success(const Success& success) {
  if (left_out_of_run_ == 0) json_.on_success(success);
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

void HtmlReport::list_properties(const std::vector<PropertyOfPage>& properties) {
  std::string list;
  JsonWriter json(list);
  std::int64_t runs = 0;
  json.open('[');
  for (const PropertyOfPage& property : properties) {
    json.open('{');
    json.write_members({{"title", property.title},
                        {"statement", property.statement},
                        {"result", property.result},
                        {"description", property.description}});
    json.write("run", property.has_run ? std::optional(runs++) : std::nullopt);
    json.close('}');
  }
  json.close(']');
  properties_json_ = R"(,"properties":)" + list;
}

void HtmlReport::end() { json_.end(); }

std::string HtmlReport::page() {
  return make_page({R"({"catalogs":)", catalogs_json_, R"(],"runs":)", runs_json_, R"(],"report":)",
                    memory_.text(), properties_json_, simulator_json_, "}"},
                   "'none'");
}

std::string stream_page(const CompiledCatalog& catalog, const StreamOfPage& stream) {
  std::string data;
  JsonWriter json(data);
  json.open('{');
  json.open("catalogs", '[');
  json.write_json(catalog_of_page(catalog));
  json.close(']');
  json.open("runs", '[');
  json.open('{');
  json.write("catalog", 0);
  json.write_json("state", stream.begin);
  json.write("left_out", stream.left_out);
  json.close('}');
  json.close(']');
  json.open("report", '{');
  json.open("runs", '[');
  json.open('{');
  json.write_members({{"catalog", catalog.file}, {"script", stream.name}});
  json.write_json("events", "[" + stream.events + "]");
  json.open("expectations", '{');
  json.write_members({{"passed", 0}, {"failed", 0}});
  json.write_json("successes", "[]");
  json.write_json("failures", "[]");
  json.close('}');
  json.close('}');
  json.close(']');
  json.close('}');
  if (!stream.token.empty()) json.write("live", stream.token);
  json.close('}');
  json.flush();
  return make_page({data}, stream.token.empty() ? "'none'" : "'self'");
}

std::string state_of_page(const CompiledCatalog& catalog, std::uint64_t index, Microseconds time,
                          const State& state) {
  Situation situation;
  std::vector<std::string_view> faulty;
  for (std::uint32_t place = 0; place < catalog.behavior_ids.size(); ++place) {
    const BehaviorId behavior = catalog.behavior_ids[place];
    if (state.is_denied(behavior)) situation.availability.push_back({place, false});
    if (state.is_faulty(behavior)) faulty.push_back(catalog.behavior_names[place]);
  }
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    situation.variables.push_back({variable, state.value_of(variable)});
  }
  std::string text;
  JsonWriter json(text);
  json.open('{');
  json.write("index", index);
  json.write_seconds("time", time);
  json::state_after.write(json, json::Running(catalog, state), catalog);
  json.key("situation");
  json::situation.write(json, json::entries_of(situation, catalog), catalog);
  json.write_list("faulty", faulty);
  json.close('}');
  json.flush();
  return text;
}

}  // namespace cbc
