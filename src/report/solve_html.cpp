#include "report/solve_html.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "page_files.h"
#include "text/json_text.h"

namespace cbc {
namespace {

using Json = nlohmann::ordered_json;

constexpr double one_percent = one_million / 100.0;

Json behavior_to_json(const CompiledCatalog& catalog, BehaviorId behavior) {
  Json performs = Json::array();
  for (const ValueId value : catalog.performs[behavior]) {
    performs.push_back({{"task", catalog.name_of_task(catalog.task_of(value))},
                        {"suitability", catalog.values.items[value].suitability / one_percent}});
  }
  Json requires_tasks = Json::array();
  for (const CompiledRequirement& requirement : catalog.requirements[behavior]) {
    requires_tasks.push_back(catalog.name_of_task(requirement.task));
  }
  return {{"name", catalog.name_of_behavior(behavior)},
          {"performs", performs},
          {"requires", requires_tasks}};
}

/// Tasks and behaviors in catalog order; suitabilities in percent.
Json catalog_to_json(const CompiledCatalog& catalog) {
  Json tasks = Json::array();
  for (const std::string_view name : catalog.task_names) tasks.push_back(name);
  Json behaviors = Json::array();
  for (const BehaviorId behavior : catalog.behavior_ids) {
    behaviors.push_back(behavior_to_json(catalog, behavior));
  }
  Json exclusive = Json::array();
  for (std::size_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    Json& list = exclusive.emplace_back(Json::array());
    for (const TaskId task : catalog.cliques[clique]) list.push_back(catalog.name_of_task(task));
  }
  return {{"tasks", tasks}, {"behaviors", behaviors}, {"exclusive", exclusive}};
}

Json situation_to_json(const CompiledCatalog& catalog, const std::vector<Availability>& situation) {
  Json json = Json::object();
  for (const Availability& entry : situation) {
    json[catalog.behavior_names[entry.behavior]] = entry.available;
  }
  return json;
}

/// JSON for a script element, which ends at the first "</script", wherever that stands, and is read
/// in another way after "<!--". In JSON a "<" can only stand in a string.
std::string for_script_element(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char character : json) {
    if (character == '<') {
      text += "\\u003c";
    } else {
      text += character;
    }
  }
  return text;
}

void put(std::string& page, std::string_view marker, std::string_view content) {
  page.replace(page.find(marker), marker.size(), content);
}

}  // namespace

void HtmlReport::begin_run(const CompiledCatalog& catalog, const Script& script) {
  auto place = std::find(catalogs_.begin(), catalogs_.end(), &catalog);
  if (place == catalogs_.end()) {
    catalogs_json_.push_back(catalog_to_json(catalog));
    place = catalogs_.insert(place, &catalog);
  }
  runs_.push_back({{"catalog", place - catalogs_.begin()},
                   {"situation", situation_to_json(catalog, script.situation)}});
  json_.begin_run(catalog, script);
}

void HtmlReport::on_event(const EventRecord& record, const Step* step, const State& state) {
  json_.on_event(record, step, state);
}

void HtmlReport::on_failure(const Failure& failure) { json_.on_failure(failure); }

void HtmlReport::on_end(const State& state) { json_.on_end(state); }

void HtmlReport::end_run(const RunResult& result, const std::string& error) {
  json_.end_run(result, error);
}

void HtmlReport::end() { json_.end(); }

std::string HtmlReport::page() {
  std::string data = R"({"catalogs":)" + to_text(catalogs_json_) + R"(,"runs":)" + to_text(runs_) +
                     R"(,"report":)";
  data += memory_.text();
  data += "}";
  std::string script;
  for (const std::string_view file : {model_js, picture_js, panels_js, page_js}) script += file;
  std::string page(page_html);
  put(page, "{{style}}", page_css);
  put(page, "{{script}}", script);
  put(page, "{{data}}", for_script_element(data));
  return page;
}

}  // namespace cbc
