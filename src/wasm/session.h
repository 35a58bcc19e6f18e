#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "core/check/check.h"
#include "core/report/event_json.h"
#include "core/script/event_lines.h"
#include "core/script/repetition.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "core/support/json.h"
#include "core/words/failure_explanation.h"
#include "core/yaml/json_value.h"
#include "runtime/coordinator/state.h"

namespace cbc::play {

/// A robot that a page drives: events are applied one by one, and any earlier state can be gone
/// back to, from where other events lead elsewhere.
///
/// A request is an object whose member `do` says what is asked for; so is the answer. What is wrong
/// with a request is the member `error` of the answer, and then nothing changes.
///
///   open     catalog (its text), name: `lint`, as cbc.lint/1; unless there are errors, a session
///            begins: `catalog` and `begin`, as the page of --html gets them, and the tasks that
///            are `requestable`
///   load     mission (its text), name: begins anew with all its entries: `lint`, and unless there
///            are errors `begin` and what an apply answers; `stopped` says why it goes no further,
///            if the clock runs away in it
///   properties  properties (the text of a property file), name: `lint`
///   apply    event (an entry of a script): `index` and `time` after it, `entry` (how many entries
///            are done) of `entries`, `first` (the index of the first new event; later ones of
///            before are gone), `events` and `failures` as the page gets them, `expectations` (how
///            many there are in all entries), `warnings`
///   advance  to (seconds; absent: when something falls due next): the same
///   goto     index (of an event; 0: before all): `index`, `time`, `entry` and `entries` where that
///            is; what follows one event at once, all that the clock does at its instant, and what
///            is expected then, belongs to it. Or entry (how many are done)
///   what_if  event (an entry): `report`, as cbc.what-if/1 with this move
///   state    `report`, as cbc.what-if/1 without moves; `timeouts`, by task; `next_due`, or null
///   why      task, index (of an event; absent: now): the `event` that decided about it, or
///            null, as `cbc solve --why --format json` has it
///   mission  `mission`: the session as a script, with expectations
class Session {
 public:
  [[nodiscard]] std::string answer(std::string_view text);

 private:
  /// An event or an expectation, or the clock that moves on, and what came of it.
  struct Entry : Call {
    bool is_settled = false;  ///< something was due then, so no other entry may have that time
    Snapshot after = {};
    Expectation reached = {};

    [[nodiscard]] bool is_expectation() const { return step.expect && !is_clock; }
  };
  struct Happened {
    Microseconds time = 0;
    GroupId group;  ///< of its search; none: it had none
    TaskId rejected = none;
  };

  void open(const yaml::JsonValue& request, JsonWriter& answer);
  void load(const yaml::JsonValue& request, JsonWriter& answer);
  void check_properties(const yaml::JsonValue& request, JsonWriter& answer) const;
  void apply(const yaml::JsonValue& request, JsonWriter& answer);
  void advance(const yaml::JsonValue& request, JsonWriter& answer);
  void go_to(const yaml::JsonValue& request, JsonWriter& answer);
  void what_if(const yaml::JsonValue& request, JsonWriter& answer);
  void tell_state(JsonWriter& answer);
  void why(const yaml::JsonValue& request, JsonWriter& answer);
  void write_mission(JsonWriter& answer) const;

  void begin(Script script);
  void resume();
  [[nodiscard]] CoordinatorOptions options() const;
  [[nodiscard]] static Questions questions();
  [[nodiscard]] const Snapshot& present() const;
  [[nodiscard]] Microseconds next_time() const;
  void take(Call call);
  void run(Entry& entry);
  void tell_present(JsonWriter& answer) const;
  void tell_place(JsonWriter& answer) const;
  void tell_news(std::uint64_t first, JsonWriter& answer);
  [[nodiscard]] std::string what_if_report(const std::vector<Step>& moves) const;
  [[nodiscard]] std::size_t decider_of(TaskId task, std::size_t index) const;

  std::shared_ptr<const CheckedCatalog> source_;
  const CompiledCatalog* catalog_ = nullptr;  ///< null: no session
  Script script_;                             ///< without its steps
  Snapshot start_;
  std::vector<std::shared_ptr<const Entry>> entries_;
  std::size_t position_ = 0;          ///< how many of them are done
  std::shared_ptr<const Entry> cut_;  ///< done after these: a part of the next one; or null
  std::vector<Happened> events_;      ///< of all entries
  std::optional<EventStream> stream_;
  std::optional<Runner> runner_;
  FailureExplanation explanation_;
  std::vector<std::string> new_events_;
  std::vector<std::string> new_failures_;
};

}  // namespace cbc::play
