#include "core/report/sentences.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/natural.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// A product of suitabilities.
class Product {
 public:
  void multiply(Millionths suitability) {
    if (suitability == 0) {
      is_zero_ = true;
      return;
    }
    decimals_ += 6;
    for (; suitability % 10 == 0; suitability /= 10) --decimals_;
    if (suitability != 1) numerator_.multiply(suitability);
  }

  [[nodiscard]] bool is_zero() const { return is_zero_; }

  [[nodiscard]] double nearest_double() const {
    if (is_zero_) return 0;
    if (decimals_ == 0) return 1;
    return std::strtod((numerator_.digits() + "e-" + std::to_string(decimals_)).c_str(), nullptr);
  }

  /// The product is at most 1.
  [[nodiscard]] std::string exact() const {
    if (is_zero_) return "0";
    if (decimals_ == 0) return "1";
    std::string text = numerator_.digits();
    text.insert(0, decimals_ - text.size(), '0');
    text.erase(text.find_last_not_of('0') + 1);
    return "0." + text;
  }

  /// In percent, with up to 4 decimals; the rest is cut off, so that a number below a limit does
  /// not look as if it reached it.
  [[nodiscard]] std::string percent() const {
    const std::string digits = exact();
    if (digits == "1") return "100";
    std::string millionths = digits.size() > 2 ? digits.substr(2, 6) : "";
    millionths.resize(6, '0');
    return format_decimal(std::stol(millionths), 4);
  }

 private:
  bool is_zero_ = false;
  Natural numerator_;
  std::size_t decimals_ = 0;  ///< the denominator is 10 to this power
};

void multiply_elsewhere(const CompiledCatalog& catalog, const State& state, std::uint32_t group,
                        Product& product) {
  for (const std::uint32_t index : state.running()) {
    const TaskId task = catalog.task_ids[index];
    if (catalog.tasks[task].group == group) continue;
    product.multiply(catalog.values[task][state.value_index(task)].suitability);
  }
}

void multiply_group(const CompiledCatalog& catalog, std::uint32_t group, const Assignment& places,
                    Product& product) {
  const TaskId first = catalog.group_tasks[group];
  for (std::uint32_t task = 0; task < places.size(); ++task) {
    if (places[task] == none) continue;
    product.multiply(catalog.values[first + task][places[task]].suitability);
  }
}

}  // namespace

double total_suitability(const CompiledCatalog& catalog, const State& state) {
  Product product;
  multiply_elsewhere(catalog, state, none, product);
  return product.nearest_double();
}

double total_suitability(const CompiledCatalog& catalog, const State& state, std::uint32_t group,
                         const Assignment& places) {
  Product product;
  multiply_elsewhere(catalog, state, group, product);
  multiply_group(catalog, group, places, product);
  return product.nearest_double();
}

std::string exact_suitability(const CompiledCatalog& catalog, const State& state,
                              std::uint32_t group, const Assignment& places) {
  Product product;
  multiply_elsewhere(catalog, state, group, product);
  if (product.is_zero()) product = {};
  multiply_group(catalog, group, places, product);
  return product.exact();
}

double idle_share(const ObjectiveValues& objective) {
  if (objective.idle_total == 0) return 1;
  return static_cast<double>(objective.idle_total - objective.idle_running) /
         static_cast<double>(objective.idle_total);
}

double to_seconds(Microseconds time) {
  return static_cast<double>(time) / static_cast<double>(second);
}

std::string task_name(const CompiledCatalog& catalog, TaskId task) {
  const std::string_view name = catalog.name_of_task(task);
  return (catalog.find_behavior(name) ? "task " : "") + printable(name);
}

std::string list_tasks(const CompiledCatalog& catalog, std::span<const TaskId> tasks,
                       std::string_view last) {
  std::vector<std::string> names;
  for (const TaskId task : tasks) names.push_back(task_name(catalog, task));
  return list_words(names, last);
}

std::string behavior_name(const CompiledCatalog& catalog, BehaviorId behavior) {
  const std::string_view name = catalog.name_of_behavior(behavior);
  return (catalog.find_task(name) ? "behavior " : "") + printable(name);
}

namespace {

/// Joins texts with commas.
class List {
 public:
  void add(std::string_view text) {
    if (!text_.empty()) text_ += ", ";
    text_ += text;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string describe_active(const CompiledCatalog& catalog,
                            const std::vector<std::uint32_t>& behaviors) {
  if (behaviors.empty()) return "no behavior is active";
  List names;
  for (const std::uint32_t behavior : behaviors) {
    names.add(printable(catalog.behavior_names[behavior]));
  }
  return "active exactly: " + names.text();
}

}  // namespace

std::string describe_situation(const CompiledCatalog& catalog, const Situation& situation) {
  List parts;
  for (const Availability& entry : situation.availability) {
    parts.add(fmt::format("{} {}", printable(catalog.behavior_names[entry.behavior]),
                          entry.available ? "available" : "unavailable"));
  }
  for (const VariableValue value : situation.variables) {
    parts.add(describe_value(catalog, value));
  }
  return parts.text().empty() ? "" : " " + parts.text();
}

std::string describe_value(const CompiledCatalog& catalog, VariableValue value) {
  return fmt::format("{} is {}", printable(catalog.name_of_variable(value.variable)),
                     printable(catalog.name_of_value(value)));
}

std::vector<std::pair<std::uint32_t, std::optional<Microseconds>>> queue_of(
    const CompiledCatalog& catalog, const State& state) {
  std::vector<std::pair<std::uint32_t, std::optional<Microseconds>>> queue;
  for (const auto& [time, index] : state.queue().entries()) queue.emplace_back(index, time);
  for (TaskId task = 0; state.waiting_count() > 0 && task < catalog.tasks.size(); ++task) {
    const std::uint32_t index = catalog.tasks[task].catalog_index;
    if (state.is_waiting(task) && !state.queue().has(index)) {
      queue.emplace_back(index, std::nullopt);
    }
  }
  std::sort(queue.begin(), queue.end());
  return queue;
}

std::string format_time(Microseconds time) {
  return fmt::format("{:.{}f}", to_seconds(time), time % 1000 == 0 ? 3 : 6);
}

std::string describe_event(const CompiledCatalog& catalog, const EventRecord& record,
                           const Step* step) {
  const VerbForm& form = form_of(record.verb);
  std::string text(form.name);
  if (record.task != none && record.verb == Verb::finish) {
    text += " task " + printable(catalog.name_of_task(record.task));
    text += record.behavior == none
                ? ", which nothing performs"
                : " (" + printable(catalog.name_of_behavior(record.behavior)) + ")";
  } else if (record.task != none) {
    text += " " + printable(catalog.name_of_task(record.task));
    if (form.has_priority) text += fmt::format(", priority {}", record.priority);
  }
  if (record.behavior != none && record.task == none) {
    text += " " + behavior_name(catalog, record.behavior);
  }
  if (form.has_cause) text += fmt::format(", {}", name_of(record.cause));
  if (step != nullptr && record.verb == Verb::situation) {
    text += describe_situation(catalog, step->situation);
  }
  if (step != nullptr && step->parameters) text += " " + printable(step->parameters->json);
  if (record.origin != Origin::script) text += fmt::format(" ({})", name_of(record.origin));
  return text;
}

std::string_view without_indentation(std::string_view line) {
  return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

std::string_view stop_word(const EventRecord& record, const StoppedTask& stopped) {
  if (stopped.has_finished) return name_of(stopped.cause);
  if (record.verb == Verb::stop && record.task == stopped.task) {
    return name_of(ChangeCause::requested);
  }
  return name_of(stopped.had_request ? ChangeCause::displaced : ChangeCause::released);
}

std::string describe_late_fault(const CompiledCatalog& catalog, BehaviorId behavior) {
  return fmt::format(
      "{} is active, and goes on; the fault takes effect at its next activation; "
      "'finish: {}, cause: process_failure' stops it",
      behavior_name(catalog, behavior), printable(catalog.name_of_behavior(behavior)));
}

std::string describe_note(const CompiledCatalog& catalog, const EventRecord& record,
                          const State& state) {
  if (record.verb == Verb::stop && record.outcome == Outcome::unchanged) {
    return task_name(catalog, record.task) + " does not run";
  }
  const BehaviorId behavior = record.behavior;
  if (behavior == none) return {};
  const std::string name = behavior_name(catalog, behavior);
  const bool is_active = state.is_active(behavior);
  if (record.verb == Verb::fault && is_active) {
    return describe_late_fault(catalog, behavior);
  }
  if (record.verb != Verb::finish || record.outcome != Outcome::unchanged || is_active) return {};
  List instead;
  for (const ValueId value : catalog.performs[behavior]) {
    const TaskId task = catalog.task_of(value);
    const std::string task_text = task_name(catalog, task);
    instead.add(
        state.is_running(task)
            ? fmt::format("{} performs {}", behavior_name(catalog, state.behavior(task)), task_text)
            : fmt::format("nothing performs {}", task_text));
  }
  return fmt::format("{} is not active: {}", name, instead.text());
}

std::string describe_expectation(const CompiledCatalog& catalog, const Expectation& expectation) {
  List parts;
  if (expectation.outcome) parts.add(fmt::format("outcome {}", name_of(*expectation.outcome)));
  for (const Expectation::Running& expected : expectation.running) {
    std::string part = printable(catalog.task_names[expected.task]) + " runs";
    if (expected.behavior) part += " with " + printable(catalog.behavior_names[*expected.behavior]);
    parts.add(part);
  }
  for (const std::uint32_t task : expectation.stopped) {
    parts.add(printable(catalog.task_names[task]) + " does not run");
  }
  if (expectation.active) parts.add(describe_active(catalog, *expectation.active));
  return parts.text();
}

namespace {

/// ", but it reaches 51.3 % at best (...)": how near to a minimum performance one can come.
std::string describe_best(const CompiledCatalog& catalog, const Reason& reason) {
  if (reason.best.empty()) return {};
  Product product;
  List factors;
  for (const ValueId id : reason.best) {
    const Value& value = catalog.values.items[id];
    product.multiply(value.suitability);
    factors.add(fmt::format("{} {} %", printable(catalog.name_of_behavior(value.behavior)),
                            format_decimal(value.suitability, 4)));
  }
  return fmt::format(", but it reaches {} % at best ({})", product.percent(), factors.text());
}

std::string place(const CompiledCatalog& catalog, const Reason& reason) {
  return fmt::format(" ({}:{})", printable(catalog.file), reason.line);
}

/// "day, dusk or night": the values of a variable in which a behavior fits.
std::string fitting_values(const CompiledCatalog& catalog, const Reason& condition) {
  std::vector<std::string> names;
  for (const FittingValue& fitting : catalog.fitting_values_of(condition.behavior)) {
    if (fitting.variable != condition.variable) continue;
    names.push_back(printable(catalog.name_of_value({fitting.variable, fitting.value})));
  }
  return list_words(names, "or");
}

std::string describe_misfit(const CompiledCatalog& catalog, const Reason& reason,
                            const std::string& behavior) {
  if (reason.variable == none) return behavior + " does not fit the situation";
  if (reason.value != none) {
    return fmt::format("{} does not fit: {}", behavior,
                       describe_value(catalog, {reason.variable, reason.value}));
  }
  return fmt::format("{} fits only where {} is {}", behavior,
                     printable(catalog.name_of_variable(reason.variable)),
                     fitting_values(catalog, reason));
}

std::string describe_protection(const EventRecord& record, const Reason& reason) {
  if (reason.is_from_any_request) {
    return "runs on request, and a reactive start never stops such a task";
  }
  const std::int32_t level = record.search != nullptr ? record.search->protection : record.priority;
  if (record.verb == Verb::start || record.verb == Verb::stop) {
    return fmt::format("runs with priority {}, higher than {}", reason.priority, level);
  }
  // A finish has no priority of its own: see docs/semantics.md, "Finish".
  if (level == 0)
    return fmt::format("runs with priority {}, and goes on if it can", reason.priority);
  return fmt::format("runs with priority {}, and goes on before tasks of priority {} do",
                     reason.priority, level);
}

/// How a behavior ended that this event therefore does not choose.
std::string describe_end(const CompiledCatalog& catalog, const EventRecord& record,
                         BehaviorId behavior) {
  const auto values = catalog.performs[behavior];
  const bool is_of_one = record.task != none || values.size() == 1;
  const std::string name = behavior_name(catalog, behavior);
  switch (record.cause) {
    case FinishCause::goal_achieved:
      return is_of_one
                 ? fmt::format(
                       "{} has just achieved its goal, so nothing performs it now",
                       task_name(catalog, record.task != none ? record.task
                                                              : catalog.task_of(values.front())))
                 : name + " has just achieved the goal of its tasks, so nothing performs them now";
    case FinishCause::time_out:
      return name + " has just timed out";
    case FinishCause::wrong_progress:
      return name + " has just ended for wrong progress";
    case FinishCause::process_failure:
      return name + " has just failed (process_failure)";
    case FinishCause::interrupted:
      return name + " has just been interrupted";
    case FinishCause::situation_change:
      return name + " has just ended, as the situation changed";
  }
  return {};
}

/// Of several tasks that start only on request.
std::string describe_missing_requests(const CompiledCatalog& catalog,
                                      const std::vector<TaskId>& tasks) {
  return list_tasks(catalog, tasks, "and") +
         " start only on request, and are not requested: request them first";
}

}  // namespace

std::string describe_reason(const CompiledCatalog& catalog, const EventRecord& record,
                            const Reason& reason) {
  const std::string task = reason.task == none ? "" : task_name(catalog, reason.task);
  const std::string behavior =
      reason.behavior == none ? "" : behavior_name(catalog, reason.behavior);
  switch (reason.kind) {
    case Reason::Kind::priority:
      return fmt::format("{} has a request of priority {}, higher than {}", task, reason.priority,
                         record.priority);
    case Reason::Kind::no_behavior:
      return fmt::format("no behavior performs {}", task);
    case Reason::Kind::is_protected:
      return fmt::format("{} {}", task, describe_protection(record, reason));
    case Reason::Kind::exclusive:
      return fmt::format("{} excludes {}", task, task_name(catalog, reason.other_task)) +
             place(catalog, reason);
    case Reason::Kind::on_request:
      return task + " starts only on request, and is not requested: request it first";
    case Reason::Kind::requires_task:
      return fmt::format("{} requires {}", behavior, task) + place(catalog, reason);
    case Reason::Kind::performance:
      return fmt::format("{} requires {} with at least {} %",
                         reason.behavior == none ? "the catalog" : behavior, task,
                         format_decimal(reason.minimum_performance, 4)) +
             place(catalog, reason) + describe_best(catalog, reason);
    case Reason::Kind::unavailable:
      return fmt::format("{} is unavailable", behavior);
    case Reason::Kind::situation:
      return describe_misfit(catalog, reason, behavior);
    case Reason::Kind::faulty:
      return fmt::format("{} is faulty", behavior);
    case Reason::Kind::finished:
      return describe_end(catalog, record, reason.behavior);
    case Reason::Kind::stopped:
      return fmt::format("{} is stopped by this event", task);
  }
  return {};
}

namespace {

/// A reason among others, and what is said of it.
struct Told {
  std::string text;
  const Reason* reason = nullptr;
  std::size_t depth = 0;  ///< how many others it helps to explain, one by one
  bool is_told = false;
};

/// Orders reasons so that one explains another: what is said of a required task stands below the
/// requirement.
class Chain {
 public:
  Chain(const CompiledCatalog& catalog, std::vector<Told> reasons)
      : catalog_(catalog), reasons_(std::move(reasons)) {}

  /// `roots`: the tasks that all is about.
  std::vector<Told> take(std::span<const TaskId> roots) && {
    for (const Told& told : reasons_) {
      if (told.reason->kind == Reason::Kind::is_protected || leads_on(*told.reason)) {
        reachable_.insert(told.reason->task);
      }
    }
    reachable_.insert(roots.begin(), roots.end());
    for (const TaskId root : roots) tell_about(root, 0);
    for (const bool is_first : {true, false}) {
      for (Told& told : reasons_) {
        const bool is_beginning = told.reason->kind == Reason::Kind::is_protected;
        if (!told.is_told && (is_beginning || !is_first)) tell(told, 0);
      }
    }
    return std::move(ordered_);
  }

 private:
  static bool leads_on(const Reason& reason) {
    return reason.behavior != none && reason.task != none;
  }

  [[nodiscard]] bool is_about(const Reason& reason, TaskId task) const {
    if (reason.kind == Reason::Kind::exclusive) {
      if (reason.task != task && reason.other_task != task) return false;
      const TaskId other = reason.task == task ? reason.other_task : reason.task;
      return visited_.contains(other) || !reachable_.contains(other);
    }
    if (reason.behavior == none) return reason.task == task;
    const auto values = catalog_.performs[reason.behavior];
    return std::any_of(values.begin(), values.end(),
                       [&](ValueId value) { return catalog_.task_of(value) == task; });
  }

  void tell_about(TaskId task, std::size_t depth) {
    if (!visited_.insert(task).second) return;
    // What leads to other tasks comes last: a behavior may perform these, too.
    for (const bool leads : {false, true}) {
      for (Told& told : reasons_) {
        if (told.is_told || leads_on(*told.reason) != leads) continue;
        if (is_about(*told.reason, task)) tell(told, depth);
      }
    }
  }

  void tell(Told& told, std::size_t depth) {
    add(told, depth);
    const Reason& reason = *told.reason;
    if (leads_on(reason)) {
      // The requirement, and the minimum of it.
      for (Told& other : reasons_) {
        const bool is_same =
            other.reason->behavior == reason.behavior && other.reason->task == reason.task;
        if (!other.is_told && is_same) add(other, depth);
      }
    }
    if (leads_on(reason) || reason.kind == Reason::Kind::is_protected) {
      tell_about(reason.task, depth + 1);
    }
  }

  void add(Told& told, std::size_t depth) {
    told.is_told = true;
    ordered_.push_back({std::move(told.text), told.reason, depth});
  }

  const CompiledCatalog& catalog_;
  std::vector<Told> reasons_;
  std::set<TaskId> reachable_;
  std::set<TaskId> visited_;
  std::vector<Told> ordered_;
};

}  // namespace

std::vector<std::string> describe_reasons(const CompiledCatalog& catalog, const EventRecord& record,
                                          std::span<const Reason> reasons,
                                          std::span<const TaskId> tasks, TaskId it) {
  std::vector<Told> sentences;
  std::vector<TaskId> told;  // protected tasks that another sentence mentions already
  const auto protection_of = [&](TaskId task) -> const Reason* {
    const auto found = std::find_if(reasons.begin(), reasons.end(), [&](const Reason& reason) {
      return reason.kind == Reason::Kind::is_protected && reason.task == task;
    });
    return found == reasons.end() || std::count(told.begin(), told.end(), task) > 0 ? nullptr
                                                                                    : &*found;
  };
  for (const Reason& reason : reasons) {
    if (reason.kind != Reason::Kind::exclusive) continue;
    TaskId other = reason.task;
    TaskId excluded = reason.other_task;
    if (other == it || (excluded != it && protection_of(other) != nullptr)) {
      std::swap(other, excluded);
    }
    const bool is_it = excluded == it;
    std::string sentence = fmt::format("{} excludes {}", task_name(catalog, other),
                                       is_it ? "it" : task_name(catalog, excluded)) +
                           place(catalog, reason);
    const TaskId guarded = is_it ? other : excluded;
    if (const Reason* const protection = protection_of(guarded)) {
      sentence +=
          fmt::format(", {} {}", is_it ? "and" : "which", describe_protection(record, *protection));
      told.push_back(guarded);
    }
    sentences.push_back({std::move(sentence), &reason});
  }
  std::vector<TaskId> on_request;
  for (const Reason& reason : reasons) {
    if (reason.kind == Reason::Kind::exclusive) continue;
    if (reason.kind == Reason::Kind::is_protected && protection_of(reason.task) == nullptr)
      continue;
    // A minimum performance implies that the task is required.
    if (reason.kind == Reason::Kind::requires_task &&
        std::any_of(reasons.begin(), reasons.end(), [&reason](const Reason& other) {
          return other.kind == Reason::Kind::performance && other.behavior == reason.behavior &&
                 other.task == reason.task;
        })) {
      continue;
    }
    if (reason.kind == Reason::Kind::on_request) on_request.push_back(reason.task);
    sentences.push_back({describe_reason(catalog, record, reason), &reason});
  }
  const bool has_several = on_request.size() > 1;
  if (has_several) {
    std::erase_if(sentences, [](const Told& sentence) {
      return sentence.reason->kind == Reason::Kind::on_request;
    });
  }
  constexpr std::size_t deepest = 8;  // deeper chains would leave no room for words
  std::vector<std::string> lines;
  std::vector<TaskId> roots(tasks.begin(), tasks.end());
  if (record.task != none) roots.push_back(record.task);  // the event says that it runs, or not
  for (const Told& sentence : Chain(catalog, std::move(sentences)).take(roots)) {
    lines.push_back(std::string(2 * std::min(sentence.depth, deepest), ' ') + sentence.text);
  }
  if (has_several) lines.push_back(describe_missing_requests(catalog, on_request));
  return lines;
}

std::vector<const Reason*> order_reasons(const CompiledCatalog& catalog,
                                         std::span<const Reason> reasons,
                                         std::span<const TaskId> tasks) {
  // That the event stops its tasks comes last.
  const bool is_event_last = !reasons.empty() && (reasons.back().kind == Reason::Kind::stopped ||
                                                  reasons.back().kind == Reason::Kind::finished);
  std::vector<Told> all;
  for (const Reason& reason : reasons.first(reasons.size() - (is_event_last ? 1 : 0))) {
    all.push_back({{}, &reason});
  }
  std::vector<const Reason*> ordered;
  for (const Told& told : Chain(catalog, std::move(all)).take(tasks)) {
    ordered.push_back(told.reason);
  }
  if (is_event_last) ordered.push_back(&reasons.back());
  return ordered;
}

std::vector<std::string> describe_rejection(const CompiledCatalog& catalog,
                                            const EventRecord& record) {
  if (record.search != nullptr && record.search->result.status == SearchStatus::unknown) {
    return {"a search limit was reached before the first solution"};
  }
  std::vector<std::string> sentences =
      describe_reasons(catalog, record, record.conflict, std::span(&record.task, 1));
  if (sentences.empty()) {
    sentences.emplace_back(
        "no consistent set of behaviors; finding the reasons would have taken too long");
  }
  return sentences;
}

namespace {

/// Digits shown after the common beginning of two long numbers.
constexpr std::size_t digits_beyond = 6;

std::string cut_digits(const std::string& number, std::size_t length) {
  return number.size() <= length + 1 ? number : number.substr(0, length) + "...";
}

std::string shorten_alone(const std::string& number) {
  const std::size_t first = std::min(number.find_first_not_of("0."), number.size());
  return cut_digits(number, std::max<std::size_t>(first, 2) + digits_beyond);
}

}  // namespace

std::pair<std::string, std::string> shorten_both(const std::string& a, const std::string& b) {
  const auto differs = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const auto equal = static_cast<std::size_t>(differs.first - a.begin());
  const std::size_t length = std::max<std::size_t>(equal, 2) + digits_beyond;
  return {cut_digits(a, length), cut_digits(b, length)};
}

std::string supporting_text(const ObjectiveValues& objective) {
  return fmt::format("{} of {}", objective.idle_running, objective.idle_total);
}

namespace {

/// The name of a value.
std::string value_name(const CompiledCatalog& catalog, TaskId task, std::uint32_t place) {
  return place == none ? "not running"
                       : printable(catalog.name_of_behavior(catalog.values[task][place].behavior));
}

/// The first objective in which the alternative loses.
std::string describe_loss(const CompiledCatalog& catalog, const EventRecord& record,
                          const WhyNot& why_not, const State& state) {
  const std::uint32_t group = record.search->group;
  const TaskId first = catalog.group_tasks[group];
  const Configuration& chosen = record.explanation.chosen;
  const Configuration& other = *why_not.alternative;
  const Difference& difference = why_not.difference;
  switch (difference.criterion) {
    case Criterion::requests:
      return fmt::format("{} of {} requests would be satisfied, not {}", other.objective.satisfied,
                         other.objective.requests, chosen.objective.satisfied);
    case Criterion::request_order:
      return fmt::format("{} would not run, although its request comes before that of {}",
                         task_name(catalog, difference.task),
                         task_name(catalog, difference.other_task));
    case Criterion::suitability: {
      const auto [theirs, ours] =
          shorten_both(exact_suitability(catalog, state, group, other.assignment),
                       exact_suitability(catalog, state, group, chosen.assignment));
      return fmt::format("suitability would be {}, not {}", theirs, ours);
    }
    case Criterion::idle:
      return fmt::format("supporting tasks running would be {}, not {}",
                         supporting_text(other.objective), supporting_text(chosen.objective));
    case Criterion::changes:
      return fmt::format("changes would be {}, not {}", other.objective.changes,
                         chosen.objective.changes);
    case Criterion::canonical: {
      const std::uint32_t task = difference.task - first;
      return fmt::format(
          "all objectives would be equal; for {}, {} comes before {} in the canonical order",
          task_name(catalog, difference.task),
          value_name(catalog, difference.task, chosen.assignment[task]),
          value_name(catalog, difference.task, other.assignment[task]));
    }
  }
  return {};
}

/// `condition`: what would differ in the alternative ("if it ran").
Sentences describe(const CompiledCatalog& catalog, const EventRecord& record,
                   const std::string& subject, const std::string& condition, const WhyNot& why_not,
                   std::span<const TaskId> tasks, TaskId it, const State& state) {
  if (why_not.is_cut) {
    return {subject + ": a search limit was reached before the reason was found", {}};
  }
  if (why_not.alternative) {
    return {fmt::format("{}: {}, {}", subject, condition,
                        describe_loss(catalog, record, why_not, state)),
            {}};
  }
  std::vector<std::string> reasons = describe_reasons(catalog, record, why_not.conflict, tasks, it);
  if (reasons.empty()) return {subject + ": the event leaves no other choice", {}};
  if (reasons.size() == 1) return {fmt::format("{}: {}", subject, reasons.front()), {}};
  return {subject + ":", std::move(reasons)};
}

}  // namespace

Sentences describe_displacement(const CompiledCatalog& catalog, const EventRecord& record,
                                const Displacement& displaced, const State& state) {
  return describe(catalog, record, task_name(catalog, displaced.task) + " stops", "if it ran",
                  displaced.why_not, std::span(&displaced.task, 1), displaced.task, state);
}

std::vector<TaskId> tasks_of(const CompiledCatalog& catalog, const Why& why) {
  if (why.queued_task != none) return {why.queued_task};
  if (why.behavior == none) return {why.task};
  std::vector<TaskId> tasks;
  for (const ValueId value : catalog.performs[why.behavior]) {
    tasks.push_back(catalog.task_of(value));
  }
  return tasks;
}

namespace {

/// Of a task that is in the queue, or a behavior of one.
Sentences describe_due(const CompiledCatalog& catalog, const EventRecord& record, const Why& why) {
  const std::string task = task_name(catalog, why.queued_task);
  const std::string subject =
      why.behavior == none
          ? fmt::format("why {} does not run: it", task)
          : fmt::format("why {} is not active: {}", behavior_name(catalog, why.behavior), task);
  const std::string time = format_time(*why.due);
  if (why.why_not.conflict.empty()) {
    return {fmt::format("{} starts by itself at {} s", subject, time), {}};
  }
  return {fmt::format("{} tries to start at {} s, but", subject, time),
          describe_reasons(catalog, record, why.why_not.conflict, tasks_of(catalog, why))};
}

}  // namespace

std::vector<TaskId> unneeded_tasks(const CompiledCatalog& catalog, const EventRecord& record,
                                   const WhyNot& why_not, std::span<const TaskId> tasks) {
  std::vector<TaskId> unneeded;
  if (!why_not.alternative) return unneeded;
  const TaskId first = catalog.group_tasks[record.search->group];
  for (const TaskId task : tasks) {
    if (catalog.tasks[task].start_on_request != 0 ||
        record.explanation.chosen.assignment[task - first] != none ||
        why_not.alternative->assignment[task - first] == none) {
      continue;
    }
    unneeded.push_back(task);
  }
  return unneeded;
}

Sentences describe_why(const CompiledCatalog& catalog, const EventRecord& record, const Why& why,
                       const State& state) {
  if (why.due) return describe_due(catalog, record, why);
  const std::vector<TaskId> tasks = tasks_of(catalog, why);
  const std::vector<TaskId> unneeded = unneeded_tasks(catalog, record, why.why_not, tasks);
  if (why.behavior != none) {
    const std::string condition =
        unneeded.empty()
            ? std::string()
            : fmt::format("nothing that runs requires {}; ", list_tasks(catalog, unneeded, "or"));
    return describe(catalog, record,
                    fmt::format("why {} is {}active", behavior_name(catalog, why.behavior),
                                why.is_active ? "" : "not "),
                    condition + (why.is_active ? "without it" : "with it"), why.why_not, tasks,
                    none, state);
  }
  const std::string name = task_name(catalog, why.task);
  std::string condition;
  if (why.why_not.alternative) {
    const TaskId first = catalog.group_tasks[record.search->group];
    const std::uint32_t place = why.why_not.alternative->assignment[why.task - first];
    if (!unneeded.empty()) condition = "nothing that runs requires it; ";
    condition +=
        place == none ? "if it did not run" : "with " + value_name(catalog, why.task, place);
  }
  const std::string subject =
      why.chosen == none
          ? fmt::format("why {} does not run", name)
          : fmt::format("why {} has {}", name, printable(catalog.name_of_behavior(why.chosen)));
  return describe(catalog, record, subject, condition, why.why_not, tasks, none, state);
}

std::string describe_alternative(const CompiledCatalog& catalog, const EventRecord& record,
                                 std::size_t place, const State& state) {
  const std::vector<Configuration>& list = record.explanation.alternatives;
  const std::uint32_t group = record.search->group;
  const TaskId first = catalog.group_tasks[group];
  const Configuration& configuration = list[place];
  const ObjectiveValues& objective = configuration.objective;
  std::string text =
      fmt::format("requests {} of {}, suitability {}, supporting tasks running {}, changes {}:",
                  objective.satisfied, objective.requests,
                  shorten_alone(exact_suitability(catalog, state, group, configuration.assignment)),
                  supporting_text(objective), objective.changes);
  bool is_first = true;
  for (std::uint32_t task = 0; task < configuration.assignment.size(); ++task) {
    const std::uint32_t value = configuration.assignment[task];
    if (value == (place == 0 ? none : list.front().assignment[task])) continue;
    text += fmt::format(
        "{} {} {}",
        !is_first    ? ","
        : place == 0 ? ""
                     : " as 1, but",
        task_name(catalog, first + task),
        value == none ? "not running" : "= " + value_name(catalog, first + task, value));
    is_first = false;
  }
  return is_first ? text + " nothing runs" : text;
}

}  // namespace cbc
