#include "unit/random_mission.h"

#include <array>
#include <string_view>

#include "core/compile/compile.h"

namespace cbc::test {

CompiledCatalog restless_catalog(Random& random, std::uint32_t tasks) {
  Shape shape;
  shape.tasks = tasks;
  shape.exclusivity_lists = tasks / 3;
  shape.minimum = 10;
  shape.on_request = 40;
  Catalog catalog = random_catalog(random, shape);
  for (Task& task : catalog.tasks) {
    if (random.percent(50)) task.timeout = random.between(1, 20) * second / 10;
    task.reactive_start = !task.start_on_request && random.percent(60);
    if (random.percent(20)) task.execution_goal = ExecutionGoal::keep_running;
  }
  return compile(catalog);
}

RandomMission::RandomMission(Random& random, const CompiledCatalog& catalog, std::size_t events)
    : random_(random), catalog_(catalog) {
  for (std::size_t i = 0; i < events; ++i) {
    if (random.percent(50)) time_ += random.between(0, second / 5);
    add_random_event();
  }
  add_reset();
}

void RandomMission::add_random_event() {
  static constexpr std::array<std::string_view, 4> texts{
      "", "{}", "{height: 2}", "{path: [[0, 0, 2], [5, 0, 2], [5, 5, 2], [0, 5, 2], [0, 0, 2]]}"};
  static constexpr std::array causes{FinishCause::goal_achieved, FinishCause::situation_change,
                                     FinishCause::wrong_progress};
  static const std::vector<Verb> verbs{Verb::start,  Verb::start,     Verb::start,     Verb::start,
                                       Verb::start,  Verb::stop,      Verb::finish,    Verb::finish,
                                       Verb::finish, Verb::fault,     Verb::repair,    Verb::repair,
                                       Verb::fault,  Verb::situation, Verb::situation, Verb::wait};
  Event event;
  event.verb = random_.pick(verbs);
  switch (event.verb) {
    case Verb::start:
      event.subject = any_task();
      event.priority = 1 + static_cast<std::int32_t>(below(4));
      if (random_.percent(50)) event.parameters = texts[below(texts.size())];
      break;
    case Verb::stop:
      event.subject = any_task();
      if (random_.percent(50)) event.priority = static_cast<std::int32_t>(below(4));
      break;
    case Verb::finish:
      event.subject = any_behavior();
      event.cause = causes[below(causes.size())];
      break;
    case Verb::fault:
    case Verb::repair:
      event.subject = any_behavior();
      break;
    case Verb::situation: {
      std::vector<Availability>& situation = situations_.emplace_back();
      for (std::uint32_t i = 0; i < 3; ++i) situation.push_back({any_behavior(), below(3) != 0});
      event.situation = situation;
      break;
    }
    case Verb::wait:
    case Verb::reconsider:
      break;
  }
  add(event);
}

void RandomMission::add_reset() {
  std::vector<Availability>& situation = situations_.emplace_back();
  Event event;
  event.verb = Verb::repair;
  for (std::uint32_t place = 0; place < catalog_.behaviors.size(); ++place) {
    situation.push_back({place, true});
    event.subject = place;
    add(event);
  }
  event.verb = Verb::situation;
  event.situation = situation;
  add(event);
  // A stop may queue others. The second one takes them off the queue.
  event.verb = Verb::stop;
  event.priority = INT32_MAX;
  for (int round = 0; round < 2; ++round) {
    for (std::uint32_t place = 0; place < catalog_.tasks.size(); ++place) {
      event.subject = place;
      add(event);
    }
  }
}

}  // namespace cbc::test
