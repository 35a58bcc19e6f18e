#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "core/script/state_json.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "python/module/arguments.h"
#include "python/module/bindings.h"
#include "python/module/errors.h"
#include "python/module/explanations.h"
#include "python/module/long_call.h"
#include "python/module/what_if.h"
#include "runtime/base/text.h"

namespace cbc::python {
namespace {

constexpr std::int64_t highest_priority = std::numeric_limits<std::int32_t>::max();

/// Calls `use` with the session while no other thread uses it.
template <typename Use>
auto with_session(PythonCoordinator& coordinator, const Use& use) {
  if (coordinator.turn.is_mine()) {
    raise("Error",
          "a coordinator cannot be used while it handles an event, as by a signal handler");
  }
  const Turn::Lock lock(coordinator.turn);
  try {
    return use(*coordinator.session);
  } catch (const CallFault& fault) {
    raise("Error", fault.what());
  }
}

std::vector<HandledEvent> run(Session& session, Call call) {
  return *call_long(
      [&](const IsStopped& is_stopped) { return session.run(std::move(call), is_stopped); });
}

/// An event, which `make_step` makes when it is the turn of this thread.
template <typename MakeStep>
std::shared_ptr<PythonEvent> handle(PythonCoordinator& coordinator, const py::object& at,
                                    const MakeStep& make_step) {
  return with_session(coordinator, [&](Session& session) {
    Call call;
    call.step = make_step(*session.catalog()->compiled);
    call.step.time = read_time(at, session.coordinator().now());
    return std::const_pointer_cast<PythonEvent>(make_event(run(session, std::move(call))));
  });
}

std::int32_t read_priority(const py::handle& priority, Verb verb) {
  return static_cast<std::int32_t>(
      read_integer(priority, "priority", form_of(verb).lowest_priority, highest_priority));
}

std::shared_ptr<PythonEvent> start(PythonCoordinator& coordinator, const py::object& task,
                                   const py::object& priority, const py::object& at,
                                   const py::object& parameters) {
  return handle(coordinator, at, [&](const CompiledCatalog& catalog) {
    Step step;
    step.verb = Verb::start;
    step.subject = read_task(catalog, task);
    if (catalog.rules_of(catalog.task_ids[step.subject]).requestable == 0) {
      raise("UsageError", concat("task ", quote(catalog.task_names[step.subject]),
                                 " cannot be requested: the catalog says 'requestable: false'"));
    }
    step.priority = read_priority(priority, Verb::start);
    step.parameters = read_parameters(catalog, step.subject, parameters);
    return step;
  });
}

std::shared_ptr<PythonEvent> stop(PythonCoordinator& coordinator, const py::object& task,
                                  const py::object& priority, const py::object& at) {
  return handle(coordinator, at, [&](const CompiledCatalog& catalog) {
    Step step;
    step.verb = Verb::stop;
    step.subject = read_task(catalog, task);
    if (!priority.is_none()) step.priority = read_priority(priority, Verb::stop);
    return step;
  });
}

std::shared_ptr<PythonEvent> finish(PythonCoordinator& coordinator, const py::object& name,
                                    const py::object& cause, const py::object& at) {
  return handle(coordinator, at, [&](const CompiledCatalog& catalog) {
    const Subject subject = read_subject(catalog, name);
    Step step;
    step.verb = Verb::finish;
    step.subject = subject.catalog_index;
    step.is_by_task = subject.is_task;
    step.cause = read_cause(cause);
    return step;
  });
}

/// Of a fault or a repair.
template <Verb verb>
std::shared_ptr<PythonEvent> change_behavior(PythonCoordinator& coordinator,
                                             const py::object& behavior, const py::object& at) {
  return handle(coordinator, at, [&](const CompiledCatalog& catalog) {
    Step step;
    step.verb = verb;
    step.subject = read_behavior(catalog, behavior);
    return step;
  });
}

std::shared_ptr<PythonEvent> change_situation(PythonCoordinator& coordinator,
                                              const py::object& values, const py::object& at,
                                              const py::kwargs& named) {
  return handle(coordinator, at, [&](const CompiledCatalog& catalog) {
    Step step;
    step.verb = Verb::situation;
    read_situation(catalog, values, step.situation);
    read_situation(catalog, named, step.situation);
    return step;
  });
}

py::tuple advance(PythonCoordinator& coordinator, const py::object& to) {
  return with_session(coordinator, [&](Session& session) {
    if (to.is_none()) raise_type_error("to: expected seconds as a number, found None");
    return make_events(run(session, clock_call(*read_time(to, session.coordinator().now()))));
  });
}

// What there is now.

/// Calls `put` with each running task.
template <typename Put>
py::dict of_running(PythonCoordinator& coordinator, const Put& put) {
  return with_session(coordinator, [&](Session& session) {
    py::dict made;
    for (const std::uint32_t index : session.state().running()) {
      const TaskId task = session.catalog()->compiled->task_ids[index];
      put(session, task, name_of_task(*session.catalog(), task), made);
    }
    return made;
  });
}

template <typename Has>
py::tuple behaviors_that(PythonCoordinator& coordinator, const Has& has) {
  return with_session(coordinator, [&](Session& session) {
    py::list names;
    for (const BehaviorId behavior : session.catalog()->compiled->behavior_ids) {
      if (has(session.state(), behavior))
        names.append(name_of_behavior(*session.catalog(), behavior));
    }
    return py::tuple(names);
  });
}

py::dict queue_of_session(PythonCoordinator& coordinator) {
  return with_session(coordinator, [](Session& session) {
    const CompiledCatalog& catalog = *session.catalog()->compiled;
    py::dict queue;
    for (const auto& [place, due] : queue_of(catalog, session.state())) {
      queue[to_str(catalog.task_names[place])] =
          due ? py::object(py::float_(to_seconds(*due))) : py::object(py::none());
    }
    return queue;
  });
}

py::dict values_of_session(PythonCoordinator& coordinator) {
  return with_session(coordinator, [](Session& session) {
    const CompiledCatalog& catalog = *session.catalog()->compiled;
    py::dict values;
    for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
      values[to_str(catalog.name_of_variable(variable))] =
          to_python(catalog, {variable, session.state().value_of(variable)});
    }
    return values;
  });
}

py::str why(PythonCoordinator& coordinator, const py::object& name) {
  return with_session(coordinator, [&](Session& session) {
    const Subject subject = read_subject(*session.catalog()->compiled, name);
    return to_str(call_long([&](const IsStopped& is_stopped) {
      return explain_present(session, subject, is_stopped);
    }));
  });
}

// Saved states.

py::bytes save(const Session& session) {
  return write_state(*session.catalog()->compiled, session.snapshot());
}

void restore_in(Session& session, const py::handle& state) {
  const StateReading reading = read_state(read_text(state, "state"), *session.catalog()->compiled);
  if (!reading.snapshot) raise("UsageError", "cannot use the state: " + reading.error);
  session.resume(*reading.snapshot);
}

std::uint64_t read_max_nodes(const py::handle& number) {
  return static_cast<std::uint64_t>(
      read_integer(number, "max_nodes", 0, std::numeric_limits<std::int64_t>::max()));
}

std::unique_ptr<PythonCoordinator> make_coordinator(const std::shared_ptr<Catalog>& catalog,
                                                    const py::object& situation,
                                                    const py::object& reactive_delay, bool timeouts,
                                                    const py::object& max_nodes,
                                                    const py::object& time_limit) {
  SessionOptions options;
  options.reactive_delay = read_seconds(reactive_delay, "reactive_delay");
  if (options.reactive_delay == 0) {
    raise("UsageError", "reactive_delay: expected more than 0 seconds, found 0");
  }
  options.timeouts = timeouts;
  options.max_nodes = read_max_nodes(max_nodes);
  options.time_limit = read_seconds(time_limit, "time_limit");
  Situation first;
  read_situation(*catalog->compiled, situation, first);
  auto session = std::make_unique<Session>(catalog, options);
  session->begin(first);
  return std::make_unique<PythonCoordinator>(std::move(session));
}

// What could happen next.

struct PythonOption {
  std::shared_ptr<const Catalog> catalog;
  std::shared_ptr<const PythonEvent> event;
  Option option;
};

py::list options(PythonCoordinator& coordinator, const py::object& priorities) {
  return with_session(coordinator, [&](Session& session) {
    std::vector<std::int32_t> wanted;
    if (PySequence_Check(priorities.ptr()) == 0 || PyUnicode_Check(priorities.ptr())) {
      raise_type_error("priorities: expected a sequence of int");
    }
    for (const py::handle priority : py::tuple(priorities)) {
      wanted.push_back(read_priority(priority, Verb::start));
    }
    py::list made;
    for (Option& option : call_long([&](const IsStopped& is_stopped) {
           return find_options(session, wanted, is_stopped);
         })) {
      auto event = make_event(std::move(option.events));
      made.append(PythonOption{session.catalog(), std::move(event), std::move(option)});
    }
    return made;
  });
}

template <typename Value, typename ToPython>
py::dict dict_of(const Catalog& catalog, const std::vector<std::pair<TaskId, Value>>& entries,
                 const ToPython& to_python) {
  py::dict made;
  for (const auto& [task, value] : entries) made[name_of_task(catalog, task)] = to_python(value);
  return made;
}

void bind_option(py::module_& module) {
  py::class_<PythonOption> type(module, "Option",
                                "Something that could happen next, and what would come of it.");
  refuse_instances(type);
  type.def("__copy__", [](const py::object& option) { return option; });
  type.def("__deepcopy__", [](const py::object& option, const py::object&) { return option; });
  const auto behaviors = [](const PythonOption& of, const auto& entries) {
    return dict_of(*of.catalog, entries,
                   [&of](BehaviorId behavior) { return name_of_behavior(*of.catalog, behavior); });
  };
  type.def_property_readonly(
      "event",
      [](const PythonOption& of) { return std::const_pointer_cast<PythonEvent>(of.event); },
      "The event; its `after` has what would follow at once.");
  type.def_property_readonly(
      "started", [behaviors](const PythonOption& of) { return behaviors(of, of.option.started); },
      "Tasks that would run, but do not run now, each with its behavior.");
  type.def_property_readonly(
      "changed", [behaviors](const PythonOption& of) { return behaviors(of, of.option.changed); },
      "Tasks that would go on with another behavior, each with that one.");
  type.def_property_readonly(
      "stopped",
      [](const PythonOption& of) {
        return make_tuple_of(of.option.effects.stopped,
                             [&of](TaskId task) { return name_of_task(*of.catalog, task); });
      },
      "Tasks that run now, but would not.");
  type.def_property_readonly(
      "requested",
      [](const PythonOption& of) {
        return dict_of(*of.catalog, of.option.requested,
                       [](std::int32_t priority) { return py::int_(priority); });
      },
      "Tasks that would go on with a request of another priority, each with that one.");
  type.def_property_readonly(
      "failed",
      [](const PythonOption& of) {
        return make_tuple_of(of.option.effects.failed, [&of](BehaviorId behavior) {
          return name_of_behavior(*of.catalog, behavior);
        });
      },
      "Behaviors whose activation would be tried and fail, as they are faulty.");
  type.def_property_readonly(
      "suspended",
      [](const PythonOption& of) {
        return make_tuple_of(of.option.effects.suspended,
                             [&of](TaskId task) { return name_of_task(*of.catalog, task); });
      },
      "Tasks whose request would be suspended.");
  type.def_property_readonly(
      "not_retried",
      [](const PythonOption& of) {
        return make_tuple_of(of.option.effects.not_retried, [&of](BehaviorId behavior) {
          return name_of_behavior(*of.catalog, behavior);
        });
      },
      "Behaviors that would have failed, and not be tried again at any event.");
  type.def_property_readonly(
      "queued",
      [](const PythonOption& of) {
        return dict_of(*of.catalog, of.option.queued,
                       [](Microseconds due) { return py::float_(to_seconds(due)); });
      },
      "Reactive tasks that would come into the queue, each with the time when it is due, in\n"
      "seconds.");
  type.def("__repr__", [](const PythonOption& of) {
    return to_str(concat(
        "<Option ",
        std::string(py::str(py::repr(py::cast(std::const_pointer_cast<PythonEvent>(of.event))))),
        ">"));
  });
}

void bind_verbs(py::class_<PythonCoordinator>& type) {
  type.def(
      "start", &start, py::arg("task"), py::arg("priority") = 1, py::kw_only(),
      py::arg("at") = py::none(), py::arg("parameters") = py::none(),
      "Requests a task, which must be requestable. `priority`: 1 or higher; higher is stronger.\n"
      "`at`: seconds on the clock; None: now. `parameters`: None: the task keeps those that it\n"
      "has.");
  type.def("stop", &stop, py::arg("task"), py::kw_only(), py::arg("priority") = py::none(),
           py::arg("at") = py::none(),
           "Stops a task. `priority`: 0 or higher; None: that of its request.");
  type.def("finish", &finish, py::arg("name"), py::arg("cause") = "goal_achieved", py::kw_only(),
           py::arg("at") = py::none(),
           "A behavior has finished, or, if `name` is a task, whatever performs it. `cause`:\n"
           "'goal_achieved' is success, 'situation_change' a change of the situation; 'time_out',\n"
           "'wrong_progress', 'process_failure' and 'interrupted' are failures.");
  type.def("fault", &change_behavior<Verb::fault>, py::arg("behavior"), py::kw_only(),
           py::arg("at") = py::none(), "Activations of a behavior fail from now on.");
  type.def("repair", &change_behavior<Verb::repair>, py::arg("behavior"), py::kw_only(),
           py::arg("at") = py::none(), "Activations of a behavior succeed again.");
  type.def("situation", &change_situation, py::arg("values") = py::none(), py::pos_only(),
           py::kw_only(), py::arg("at") = py::none(),
           "Changes the situation: names of variables with their values, and of behaviors with\n"
           "whether they can be activated. What is not named stays as it is.");
  type.def("advance", &advance, py::arg("to"),
           "Moves the clock to a time in seconds, and does all that falls due until then. Returns\n"
           "a tuple of the events of the clock.");
}

void bind_state(py::class_<PythonCoordinator>& type) {
  type.def_property_readonly(
      "catalog",
      [](const PythonCoordinator& of) {
        return std::const_pointer_cast<Catalog>(of.session->catalog());
      },
      "The catalog.");
  type.def_property_readonly(
      "now",
      [](PythonCoordinator& of) {
        return with_session(
            of, [](Session& session) { return to_seconds(session.coordinator().now()); });
      },
      "Seconds on the clock, which starts at 0 and never goes back.");
  type.def_property_readonly(
      "next_due",
      [](PythonCoordinator& of) {
        return with_session(of, [](Session& session) -> py::object {
          const auto due = session.coordinator().next_due();
          return due ? py::object(py::float_(to_seconds(*due))) : py::object(py::none());
        });
      },
      "When something falls due next, in seconds, unless an event changes that; None: never.");
  type.def_property_readonly(
      "running",
      [](PythonCoordinator& of) {
        return of_running(of, [](Session& session, TaskId task, const py::str& name, py::dict& to) {
          to[name] = name_of_behavior(*session.catalog(), session.state().behavior(task));
        });
      },
      "The running tasks in catalog order, each with its behavior.");
  type.def_property_readonly(
      "requests",
      [](PythonCoordinator& of) {
        return of_running(of, [](Session& session, TaskId task, const py::str& name, py::dict& to) {
          const Request* const request = session.state().find_request(task);
          if (request != nullptr) to[name] = request->priority;
        });
      },
      "The running tasks that have a request, each with its priority; 0: it started by itself.");
  type.def_property_readonly(
      "suspended",
      [](PythonCoordinator& of) {
        return with_session(of, [](Session& session) {
          const Catalog& catalog = *session.catalog();
          py::dict made;
          for (const TaskId task : catalog.compiled->task_ids) {
            if (!session.state().is_suspended(task)) continue;
            made[name_of_task(catalog, task)] = session.state().find_own_request(task)->priority;
          }
          return made;
        });
      },
      "The tasks that do not run, but whose request is suspended, each with its priority.");
  type.def_property_readonly("queue", &queue_of_session,
                             "The reactive tasks that will start by themselves, each with its due "
                             "time in seconds; None: it waits for a change of its group.");
  type.def_property_readonly(
      "active",
      [](PythonCoordinator& of) {
        return behaviors_that(
            of, [](const State& state, BehaviorId behavior) { return state.is_active(behavior); });
      },
      "The active behaviors in catalog order.");
  type.def_property_readonly(
      "faulty",
      [](PythonCoordinator& of) {
        return behaviors_that(
            of, [](const State& state, BehaviorId behavior) { return state.is_faulty(behavior); });
      },
      "The faulty behaviors in catalog order.");
  type.def_property_readonly(
      "failed",
      [](PythonCoordinator& of) {
        return behaviors_that(
            of, [](const State& state, BehaviorId behavior) { return state.has_failed(behavior); });
      },
      "The behaviors that have failed, and are not tried again at any event, in catalog order.");
  type.def_property_readonly(
      "unavailable",
      [](PythonCoordinator& of) {
        return behaviors_that(
            of, [](const State& state, BehaviorId behavior) { return state.is_denied(behavior); });
      },
      "The behaviors that situation() made unavailable, in catalog order.");
  type.def_property_readonly("variables", &values_of_session,
                             "The situation variables in catalog order, each with its value.");
  type.def("why", &why, py::arg("name"),
           "Why a task or behavior is as it is now, in the words of `cbc solve --why`.");
  type.def("options", &options, py::kw_only(), py::arg("priorities") = py::make_tuple(1),
           "What could happen next, as `cbc solve --what-if` has it: a list of Option, at the end\n"
           "what the clock does if nothing else happens. Nothing is changed.");
}

}  // namespace

void bind_coordinator(py::module_& module) {
  bind_option(module);
  py::class_<PythonCoordinator> type(
      module, "Coordinator",
      "Decides what a robot does at every event: see cbc-events(5).\n\n"
      "`situation`: before the first event. `reactive_delay`: seconds from when a reactive task\n"
      "could start until it starts. `max_nodes`, `time_limit` (seconds): end the search of one\n"
      "event; 0: no limit. Threads may use one coordinator; they take turns.");
  type.def(py::init(&make_coordinator), py::arg("catalog").none(false), py::kw_only(),
           py::arg("situation") = py::none(), py::arg("reactive_delay") = 0.08,
           py::arg("timeouts") = true, py::arg("max_nodes") = 0, py::arg("time_limit") = 0.0);
  bind_verbs(type);
  bind_state(type);
  type.def(
      "save",
      [](PythonCoordinator& of) {
        return with_session(of, [](Session& session) { return save(session); });
      },
      "The state, as `cbc solve --state-out` writes it (schema cbc.state/1).");
  type.def(
      "restore",
      [](PythonCoordinator& of, const py::object& state) {
        with_session(of, [&state](Session& session) { restore_in(session, state); });
      },
      py::arg("state"), "Continues from a saved state of the same catalog.");
  const auto copy = [](PythonCoordinator& of) {
    return with_session(
        of, [](Session& session) { return std::make_unique<PythonCoordinator>(session.clone()); });
  };
  type.def("__copy__", copy);
  type.def("__deepcopy__", [copy](PythonCoordinator& of, const py::object&) { return copy(of); });
  type.def(py::pickle(
      [](PythonCoordinator& of) {
        return with_session(of, [](Session& session) {
          const SessionOptions& limits = session.options();
          return py::make_tuple(std::const_pointer_cast<Catalog>(session.catalog()),
                                limits.max_nodes, limits.time_limit, save(session));
        });
      },
      [](const py::tuple& state) {
        if (state.size() != 4) raise("UsageError", "this is not the state of a Coordinator");
        SessionOptions limits;
        if (!py::isinstance<Catalog>(state[0])) raise_type_error("state: expected a Catalog first");
        limits.max_nodes = read_max_nodes(state[1]);
        limits.time_limit = read_integer(state[2], "time_limit", 0, longest_time);
        auto session =
            std::make_unique<Session>(py::cast<std::shared_ptr<Catalog>>(state[0]), limits);
        restore_in(*session, state[3]);
        return std::make_unique<PythonCoordinator>(std::move(session));
      }));
  type.def("__repr__", [](PythonCoordinator& of) {
    return with_session(of, [](Session& session) {
      const std::size_t running = session.state().running().size();
      return to_str(concat("<Coordinator of ", quote(session.catalog()->name), " at ",
                           format_time(session.coordinator().now()),
                           " s: ", quantity(running, "task"), running == 1 ? " runs>" : " run>"));
    });
  });
}

}  // namespace cbc::python
