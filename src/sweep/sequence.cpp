#include "sweep/sequence.h"

#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "script/runner.h"
#include "sweep/event_generator.h"
#include "text/decimal.h"

namespace cbc {
namespace {

CoordinatorOptions to_coordinator_options(const SweepSearch& search) {
  CoordinatorOptions options;
  options.search.max_solutions = search.max_solutions;
  options.search.max_nodes = search.max_nodes;
  options.tie_seed = search.tie_seed;
  options.max_clock_events = search.max_clock_events;
  return options;
}

class Sequence final : public EventListener {
 public:
  Sequence(const CompiledCatalog& catalog, const SweepSettings& settings, std::uint64_t sequence,
           SequenceListener& listener)
      : shape_(settings.shape),
        listener_(listener),
        generator_(catalog, settings.shape, settings.seed, sequence),
        coordinator_(catalog, to_coordinator_options(settings.search), *this) {}

  /// Steps are added to `record` before they are run, unless it is null.
  [[nodiscard]] SequenceEnd run(std::vector<Step>* record) {
    const Coordinator::Status status = take_all(record);
    return {status, coordinator_.internal_error()};
  }

  void on_event(const EventRecord& record) override {
    listener_.on_event(record, coordinator_.state());
  }

 private:
  [[nodiscard]] Coordinator::Status take_all(std::vector<Step>* record) {
    coordinator_.begin({});
    for (std::uint32_t event = 0; event < shape_.events; ++event) {
      const auto status = take_next(record);
      if (status != Coordinator::Status::ok) return status;
    }
    return coordinator_.settle();
  }

  [[nodiscard]] Coordinator::Status take_next(std::vector<Step>* record) {
    Step step;
    step.time = generator_.draw_time(coordinator_);
    if (record != nullptr) record->push_back(step);
    const auto status = coordinator_.advance_to(*step.time);
    if (status != Coordinator::Status::ok) return status;
    generator_.draw_event(coordinator_.state(), step);
    if (record != nullptr) record->back() = step;
    return coordinator_.handle(event_of(step));
  }

  const SweepShape shape_;
  SequenceListener& listener_;
  EventGenerator generator_;
  Coordinator coordinator_;
};

/// Notes how many steps it takes to an event.
class StepCounter final : public SequenceListener {
 public:
  StepCounter(const std::vector<Step>& steps, std::uint64_t index) : steps_(steps), index_(index) {}
  void on_event(const EventRecord& record, const State& /*state*/) override {
    if (record.index == index_) count_ = steps_.size();
  }
  [[nodiscard]] std::size_t count() const { return count_ == 0 ? steps_.size() : count_; }

 private:
  const std::vector<Step>& steps_;
  const std::uint64_t index_;
  std::size_t count_ = 0;
};

// Scripts. Names are quoted as in JSON, so that no name is taken for something else.

std::string in_quotes(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string describe_step(const CompiledCatalog& catalog, const Step& step) {
  const auto verb_of = [&](const Texts& names) {
    return fmt::format("{}: {}", name_of(step.verb), in_quotes(names[step.subject]));
  };
  std::string text;
  switch (step.verb) {
    case Verb::start:
    case Verb::stop:
      text = verb_of(catalog.task_names);
      if (step.priority) text += fmt::format(", priority: {}", *step.priority);
      if (step.parameters) text += fmt::format(", parameters: {}", step.parameters->json);
      return text;
    case Verb::finish:
      return verb_of(catalog.behavior_names) + fmt::format(", cause: {}", name_of(step.cause));
    case Verb::fault:
    case Verb::repair:
      return verb_of(catalog.behavior_names);
    case Verb::situation:
      for (const Availability& entry : step.situation) {
        text += fmt::format("{}{}: {}", text.empty() ? "" : ", ",
                            in_quotes(catalog.behavior_names[entry.behavior]), entry.available);
      }
      return "situation: {" + text + "}";
    case Verb::wait:
      break;
  }
  return {};
}

}  // namespace

SequenceEnd run_sequence(const CompiledCatalog& catalog, const SweepSettings& settings,
                         std::uint64_t sequence, SequenceListener& listener) {
  return Sequence(catalog, settings, sequence, listener).run(nullptr);
}

std::vector<Step> steps_of_sequence(const CompiledCatalog& catalog, const SweepSettings& settings,
                                    std::uint64_t sequence, std::uint64_t index) {
  std::vector<Step> steps;
  StepCounter counter(steps, index);
  static_cast<void>(Sequence(catalog, settings, sequence, counter).run(&steps));
  steps.resize(counter.count());
  return steps;
}

std::string write_script(const CompiledCatalog& catalog, const std::vector<Step>& steps,
                         const std::string& comment) {
  std::string text;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) text += "# " + line + "\n";
  text += "events:\n";
  for (const Step& step : steps) {
    const std::string event = describe_step(catalog, step);
    text += fmt::format("- {{at: {}{}{}}}\n", format_decimal(step.time.value_or(0), 6),
                        event.empty() ? "" : ", ", event);
  }
  return text;
}

std::string options_for_script(const SweepSearch& search) {
  std::string text;
  if (search.max_solutions > 0) text += fmt::format(" --max-solutions {}", search.max_solutions);
  if (search.max_nodes > 0) text += fmt::format(" --max-nodes {}", search.max_nodes);
  if (search.tie_seed) text += fmt::format(" --tie-seed {}", *search.tie_seed);
  if (search.max_clock_events != SweepSearch{}.max_clock_events) {
    text += fmt::format(" --max-clock-events {}", search.max_clock_events);
  }
  return text;
}

}  // namespace cbc
