#include "report/explanation_json.h"

#include <cstdint>
#include <string>

#include "report/exact_values.h"
#include "report/explanation.h"
#include "report/reasons.h"
#include "report/reasons_json.h"

namespace cbc {
namespace {

using Json = nlohmann::ordered_json;

Json behavior_to_json(const CompiledCatalog& catalog, BehaviorId behavior) {
  return behavior == none ? Json(nullptr) : Json(catalog.name_of_behavior(behavior));
}

Json value_to_json(const CompiledCatalog& catalog, TaskId task, std::uint32_t place) {
  return behavior_to_json(catalog, place == none ? none : catalog.values[task][place].behavior);
}

/// The running tasks of the group, in catalog order, and the objectives.
Json configuration_to_json(const CompiledCatalog& catalog, const EventRecord& record,
                           const Configuration& configuration, const State& state) {
  const std::uint32_t group = record.search->group;
  const TaskId first = catalog.group_tasks[group];
  Json running = Json::object();
  for (std::uint32_t task = 0; task < configuration.places.size(); ++task) {
    const std::uint32_t place = configuration.places[task];
    if (place == none) continue;
    running[std::string(catalog.name_of_task(first + task))] =
        value_to_json(catalog, first + task, place);
  }
  const ObjectiveValues& objective = configuration.objective;
  return {{"running", std::move(running)},
          {"objective",
           {{"satisfied", objective.satisfied},
            {"requests", objective.requests},
            {"suitability", total_suitability(catalog, state, group, configuration.places)},
            {"idle", idle_share(objective)},
            {"changes", objective.changes}}}};
}

std::string idle_fraction(const ObjectiveValues& objective) {
  return std::to_string(objective.idle_total - objective.idle_running) + "/" +
         std::to_string(objective.idle_total);
}

Json loss_to_json(const CompiledCatalog& catalog, const EventRecord& record, const WhyNot& why_not,
                  const State& state) {
  const std::uint32_t group = record.search->group;
  const Configuration& chosen = record.explanation.chosen;
  const Configuration& other = *why_not.alternative;
  const Difference& difference = why_not.difference;
  Json json = {{"objective", name_of(difference.criterion)}};
  const auto add = [&](const Json& ours, const Json& theirs) {
    json["chosen"] = ours;
    json["alternative"] = theirs;
  };
  switch (difference.criterion) {
    case Criterion::requests:
      add(chosen.objective.satisfied, other.objective.satisfied);
      break;
    case Criterion::request_order:
      add(catalog.name_of_task(difference.task), catalog.name_of_task(difference.other_task));
      break;
    case Criterion::suitability:
      add(exact_suitability(catalog, state, group, chosen.places),
          exact_suitability(catalog, state, group, other.places));
      break;
    case Criterion::idle:
      add(idle_fraction(chosen.objective), idle_fraction(other.objective));
      break;
    case Criterion::changes:
      add(chosen.objective.changes, other.objective.changes);
      break;
    case Criterion::canonical: {
      const std::uint32_t task = difference.task - catalog.group_tasks[group];
      json["task"] = catalog.name_of_task(difference.task);
      add(value_to_json(catalog, difference.task, chosen.places[task]),
          value_to_json(catalog, difference.task, other.places[task]));
      break;
    }
  }
  return json;
}

/// In one text.
std::string message_of(const Sentences& sentences) {
  std::string text = sentences.first;
  for (std::size_t place = 0; place < sentences.more.size(); ++place) {
    text += (place == 0 ? " " : "; ") + sentences.more[place];
  }
  return text;
}

}  // namespace

Json why_to_json(const CompiledCatalog& catalog, const EventRecord& record, const State& state) {
  Json list = Json::array();
  for (const Why& why : record.explanation.why) {
    Json& entry = list.emplace_back(Json::object());
    if (why.behavior != none) {
      entry["behavior"] = catalog.name_of_behavior(why.behavior);
      entry["active"] = why.is_active;
    } else {
      entry["task"] = catalog.name_of_task(why.task);
      entry["chosen"] = behavior_to_json(catalog, why.chosen);
    }
    const WhyNot& why_not = why.why_not;
    entry["limit_reached"] = why_not.is_cut;
    entry["alternative"] = why_not.alternative
                               ? configuration_to_json(catalog, record, *why_not.alternative, state)
                               : Json(nullptr);
    entry["loses"] =
        why_not.alternative ? loss_to_json(catalog, record, why_not, state) : Json(nullptr);
    entry["conflict"] = Json::parse(reasons_to_json(catalog, record, why_not.conflict));
    entry["message"] = message_of(describe_why(catalog, record, why, state));
  }
  return list;
}

Json alternatives_to_json(const CompiledCatalog& catalog, const EventRecord& record,
                          const State& state) {
  Json list = Json::array();
  for (const Configuration& configuration : record.explanation.alternatives) {
    list.push_back(configuration_to_json(catalog, record, configuration, state));
  }
  return {{"limit_reached", record.explanation.is_list_cut}, {"configurations", std::move(list)}};
}

}  // namespace cbc
