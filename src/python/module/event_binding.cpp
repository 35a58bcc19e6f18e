#include <algorithm>
#include <string>
#include <utility>

#include "core/words/words.h"
#include "python/module/bindings.h"
#include "python/module/errors.h"
#include "python/module/explanations.h"
#include "python/module/long_call.h"
#include "runtime/base/text.h"

namespace cbc::python {
namespace {

using EventHolder = std::shared_ptr<const PythonEvent>;

/// Refers to a part of an event, and keeps the event.
template <typename Part>
struct PartOfEvent {
  EventHolder of;
  Part part;

  [[nodiscard]] const Catalog& catalog() const { return *of->event.past->catalog; }
  bool operator==(const PartOfEvent& other) const;
};
using PythonChange = PartOfEvent<Change>;
using PythonStop = PartOfEvent<StoppedTask>;

py::object optional_int(const std::optional<std::int32_t>& number) {
  return number ? py::object(py::int_(*number)) : py::object(py::none());
}

py::tuple tasks_of(const PythonChange& change) {
  return make_tuple_of(change.of->event.record.tasks_of(change.part),
                       [&](TaskId task) { return name_of_task(change.catalog(), task); });
}

std::string_view op_of(const Change& change) {
  return change.is_activation ? "activate" : "deactivate";
}

py::tuple as_tuple(const PythonChange& change) {
  return py::make_tuple(to_str(op_of(change.part)),
                        name_of_behavior(change.catalog(), change.part.behavior), tasks_of(change),
                        to_str(name_of(change.part.cause)), optional_int(change.part.priority),
                        change.part.success);
}

py::tuple as_tuple(const PythonStop& stop) {
  return py::make_tuple(name_of_task(stop.catalog(), stop.part.task),
                        to_str(stop_word(stop.of->event.record, stop.part)));
}

/// Equality, hash and copies of values that never change.
template <typename Value, typename Class, typename AsTuple>
void bind_value(Class& type, AsTuple tuple_of) {
  type.def("__eq__", [tuple_of](const Value& one, const py::object& other) -> py::object {
    if (!py::isinstance<Value>(other)) {
      return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    }
    return py::bool_(tuple_of(one).equal(tuple_of(py::cast<const Value&>(other))));
  });
  type.def("__hash__", [tuple_of](const Value& value) { return py::hash(tuple_of(value)); });
  type.def("__copy__", [](const py::object& value) { return value; });
  type.def("__deepcopy__", [](const py::object& value, const py::object&) { return value; });
}

void bind_change(py::module_& module) {
  py::class_<PythonChange> type(module, "Change", "One activation or deactivation of a behavior.");
  refuse_instances(type);
  type.def_property_readonly(
      "op", [](const PythonChange& change) { return to_str(op_of(change.part)); },
      "'activate' or 'deactivate'.");
  type.def_property_readonly(
      "behavior",
      [](const PythonChange& change) {
        return name_of_behavior(change.catalog(), change.part.behavior);
      },
      "The behavior.");
  type.def_property_readonly("tasks", &tasks_of,
                             "The tasks that it performs from now on, or performed until now.");
  type.def_property_readonly(
      "cause", [](const PythonChange& change) { return to_str(name_of(change.part.cause)); },
      "'requested', 'resumed', 'reactive', 'required', 'replaced', 'displaced', 'released',\n"
      "'restarted' or 'undone'.");
  type.def_property_readonly(
      "priority", [](const PythonChange& change) { return optional_int(change.part.priority); },
      "The highest of the requests of its tasks; None: there is none.");
  type.def_property_readonly(
      "success", [](const PythonChange& change) { return change.part.success; },
      "False: the activation failed, as the behavior is faulty.");
  type.def("__repr__", [](const PythonChange& change) {
    return to_str(concat("<Change ", change.part.is_activation ? "+" : "-",
                         change.catalog().compiled->name_of_behavior(change.part.behavior), " (",
                         name_of(change.part.cause), change.part.success ? ")>" : ", failed)>"));
  });
  bind_value<PythonChange>(type, [](const PythonChange& change) { return as_tuple(change); });
}

void bind_stop(py::module_& module) {
  py::class_<PythonStop> type(module, "StoppedTask", "A task that an event stopped.");
  refuse_instances(type);
  type.def_property_readonly(
      "task", [](const PythonStop& stop) { return name_of_task(stop.catalog(), stop.part.task); },
      "The task.");
  type.def_property_readonly(
      "cause",
      [](const PythonStop& stop) { return to_str(stop_word(stop.of->event.record, stop.part)); },
      "'requested', 'displaced', 'released', or the cause of the finish of its behavior.");
  type.def("__repr__", [](const PythonStop& stop) {
    return to_str(concat("<StoppedTask ", stop.catalog().compiled->name_of_task(stop.part.task),
                         " (", stop_word(stop.of->event.record, stop.part), ")>"));
  });
  bind_value<PythonStop>(type, [](const PythonStop& stop) { return as_tuple(stop); });
}

template <typename Part>
py::tuple parts_of(const EventHolder& event, const std::vector<Part>& parts) {
  return make_tuple_of(parts, [&](const Part& part) {
    return py::cast(PartOfEvent<Part>{event, part});
  });
}

py::tuple tuple_of(const std::vector<EventHolder>& events) {
  return make_tuple_of(events, [](const EventHolder& event) {
    return py::cast(std::const_pointer_cast<PythonEvent>(event));
  });
}

py::object subject_of(const PythonEvent& event) {
  const EventRecord& record = event.event.record;
  const Catalog& catalog = *event.event.past->catalog;
  if (record.behavior != none) return name_of_behavior(catalog, record.behavior);
  if (record.task == none || record.verb == Verb::finish) return py::none();
  return name_of_task(catalog, record.task);
}

/// "start DELIVER, priority 2: accepted"
std::string words_of_event(const PythonEvent& event) {
  const PastCall& past = *event.event.past;
  const EventRecord& record = event.event.record;
  return event_and_outcome(*past.catalog->compiled, record, past.step_of(record));
}

template <typename Answer>
py::str ask(const PythonEvent& event, Answer answer) {
  return to_str(
      call_long([&](const IsStopped& is_stopped) { return answer(event.event, is_stopped); }));
}

}  // namespace

std::shared_ptr<const PythonEvent> make_event(std::vector<HandledEvent> events) {
  const auto is_asked_for = [](const HandledEvent& event) {
    return event.record.origin == Origin::script;
  };
  auto main = std::find_if(events.begin(), events.end(), is_asked_for);
  if (main == events.end()) main = events.begin();  // what the clock alone would do
  auto made = std::make_shared<PythonEvent>();
  for (auto event = events.begin(); event != events.end(); ++event) {
    if (event == main) continue;
    auto other = std::make_shared<const PythonEvent>(PythonEvent{std::move(*event), {}, {}});
    (event < main ? made->before : made->after).push_back(std::move(other));
  }
  made->event = std::move(*main);
  return made;
}

py::tuple make_events(std::vector<HandledEvent> events) {
  std::vector<EventHolder> made;
  made.reserve(events.size());
  for (HandledEvent& event : events) {
    made.push_back(std::make_shared<const PythonEvent>(PythonEvent{std::move(event), {}, {}}));
  }
  return tuple_of(made);
}

void bind_events(py::module_& module) {
  bind_change(module);
  bind_stop(module);
  py::class_<PythonEvent, std::shared_ptr<PythonEvent>> type(
      module, "Event", "What one event did. It never changes.");
  refuse_instances(type);
  const auto record_of = [](const PythonEvent& event) -> const EventRecord& {
    return event.event.record;
  };
  type.def_property_readonly(
      "accepted",
      [](const PythonEvent& event) { return event.event.record.outcome != Outcome::rejected; },
      "False: it was rejected, and nothing changed.");
  type.def_property_readonly(
      "outcome",
      [](const PythonEvent& event) { return to_str(name_of(event.event.record.outcome)); },
      "'accepted', 'rejected', or 'unchanged': there was nothing to decide.");
  type.def_property_readonly(
      "proven", [](const PythonEvent& event) { return event.event.is_proven; },
      "Whether the answer is proven to be the best; False: a limit ended the search.");
  type.def_property_readonly(
      "time", [](const PythonEvent& event) { return to_seconds(event.event.record.time); },
      "Seconds on the clock of the coordinator.");
  type.def_property_readonly(
      "index", [](const PythonEvent& event) { return event.event.record.index; },
      "Number of the event, from 1, those of the clock included.");
  type.def_property_readonly(
      "origin", [](const PythonEvent& event) { return to_str(name_of(event.event.record.origin)); },
      "'script': this program; 'timeout', 'reactive', 'fault' or 'situation': see cbc-solve(1).");
  type.def_property_readonly(
      "verb", [](const PythonEvent& event) { return to_str(name_of(event.event.record.verb)); },
      "'start', 'stop', 'finish', 'situation', 'fault' or 'repair'.");
  type.def_property_readonly("name", &subject_of,
                             "The task of start and stop, the behavior of finish, fault and "
                             "repair; None: there is none.");
  type.def_property_readonly(
      "priority",
      [record_of](const PythonEvent& event) {
        const EventRecord& record = record_of(event);
        return form_of(record.verb).has_priority ? py::object(py::int_(record.priority))
                                                 : py::object(py::none());
      },
      "Of start and stop.");
  type.def_property_readonly(
      "cause",
      [record_of](const PythonEvent& event) {
        const EventRecord& record = record_of(event);
        return form_of(record.verb).has_cause ? py::object(to_str(cbc::name_of(record.cause)))
                                              : py::object(py::none());
      },
      "Of finish.");
  type.def_property_readonly(
      "changes",
      [](const std::shared_ptr<PythonEvent>& event) {
        return parts_of(event, event->event.record.changes);
      },
      "The activations and deactivations, in the order in which a robot carries them out.");
  type.def_property_readonly(
      "stopped",
      [](const std::shared_ptr<PythonEvent>& event) {
        return parts_of(event, event->event.record.stopped_tasks);
      },
      "The tasks that the event stopped, in catalog order.");
  type.def_property_readonly(
      "before", [](const PythonEvent& event) { return tuple_of(event.before); },
      "Events of the clock that fell due before this one, in order.");
  type.def_property_readonly(
      "after", [](const PythonEvent& event) { return tuple_of(event.after); },
      "Events that followed from this one at once, such as the end of behaviors that do not fit a\n"
      "new situation, in order.");
  type.def(
      "why", [](const PythonEvent& event) { return ask(event, &explain_event); },
      "Why the event was rejected, or what it displaced and why, in the words of `cbc solve`.");
  type.def(
      "to_json",
      [](const PythonEvent& event) {
        return py::module_::import("json").attr("loads")(ask(event, &event_to_json));
      },
      "The event as `cbc solve --format json` has it, with the state after it (schema "
      "cbc.solve/1).");
  type.def("__repr__", [](const PythonEvent& event) {
    return to_str(concat("<Event ", event.event.record.index, " at ",
                         format_time(event.event.record.time), " s: ", words_of_event(event), ">"));
  });
  type.def("__copy__", [](const py::object& event) { return event; });
  type.def("__deepcopy__", [](const py::object& event, const py::object&) { return event; });
}

}  // namespace cbc::python
