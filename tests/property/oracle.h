// The coordinator, written from the definition of catalogs and scripts alone and by the letter, as
// slow and as simple as it can be. The implementation under test must give the same events.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "enumeration.h"
#include "model.h"
#include "statistics.h"

namespace cbc::oracle {

struct Request {
  int priority = 0;
  Parameters parameters;
  std::int64_t set_by = 0;  // number of the event that last set it
};

struct State {
  Assignment values;
  std::vector<std::optional<Request>> requests;   // of each running task
  std::vector<std::optional<Request>> suspended;  // of each task that does not run
};

// A start, stop or finish, of whatever origin; or that a group is decided anew.
struct Trigger {
  Verb verb = Verb::start;
  std::size_t subject = none;  // a task, the behavior that finishes, or a group
  int priority = 0;            // start, stop
  bool reactive = false;       // a start from the queue
  std::optional<Parameters> parameters;
  Cause cause = Cause::goal_achieved;
};

// An accepted start, stop or finish: what was asked, and all that mattered for the answer.
struct Answer {
  Trigger trigger;
  Problem problem;
  Solution solution;
  State before;
  std::vector<bool> own;                    // of each behavior
  std::vector<std::size_t> variables;       // the value of each
  std::vector<std::size_t> finished_tasks;  // of a finish: what the behavior performed
  std::set<std::size_t> excluded;           // behaviors that may not be chosen
  int level = 0;                            // of protection
  State after = {};
  // The tasks of the group in Q after the event: whether a reactive start would have a solution
  // now.
  std::map<std::size_t, bool> queued = {};
};

std::set<std::size_t> active_behaviors(const Assignment& values);

// Whether two parameters are the same data: mappings without order; null, empty and absent alike.
bool same_parameters(const Parameters& a, const Parameters& b);

class Oracle {
 public:
  // Only the delay and the situation of the script are used; its events are given to handle().
  // Statistics may be null.
  Oracle(std::shared_ptr<const CatalogFacts> facts, const Script& script, Statistics* statistics);

  // Moves the clock to the event, runs what is due before it, then the event.
  void handle(const Event& event);

  // Runs what is due by the last instant of the script.
  void finish();

  // All that happened so far; `search` lacks solutions and nodes, and `conflict` is left out.
  const nlohmann::ordered_json& events() const { return events_; }

  // The accepted answers from here on are kept, by the index of their event.
  void keep_answers() { keeps_answers_ = true; }
  const std::map<std::int64_t, Answer>& answers() const { return answers_; }

  // `variants` are the facts with fewer constraints, and the same groups. From here on differing()
  // has, by the index of an event, the places of those with which the last attempt at its answer
  // would have another one; and `none` if a start was rejected that would be accepted if no task
  // were protected.
  void compare_with(std::vector<CatalogFacts> variants);
  const std::map<std::int64_t, std::set<std::size_t>>& differing() const { return differing_; }

  // What the event would do, as events(). Statistics may be null.
  nlohmann::ordered_json preview(const Event& event, Statistics* statistics) const;

  const CatalogFacts& facts() const { return *facts_; }
  const State& state() const { return state_; }
  bool own(std::size_t behavior) const { return own_[behavior]; }
  bool fits(std::size_t behavior) const { return facts_->fits(behavior, variables_); }
  bool available(std::size_t behavior) const {
    return own(behavior) && fits(behavior) && !failed_.contains(behavior);
  }
  const std::vector<std::size_t>& variables() const { return variables_; }  // their values
  bool faulty(std::size_t behavior) const { return faulty_[behavior]; }
  bool failed(std::size_t behavior) const { return failed_.contains(behavior); }
  const std::set<std::size_t>& waiting() const { return waiting_; }  // W
  Microseconds now() const { return now_; }
  std::optional<Microseconds> next_due_time() const;

 private:
  enum class DueKind { timeout, reactive_start };
  struct Due {
    Microseconds time = 0;
    DueKind kind = DueKind::timeout;
    int below_highest = 0;  // of a reactive start: less for a higher priority
    std::size_t task = 0;

    auto operator<=>(const Due&) const = default;
  };

  // A start, stop or finish while it is solved and applied.
  struct Transition {
    Trigger trigger;
    std::vector<std::size_t> finished_tasks;  // of a finish: what the behavior performed
    std::size_t group = 0;
    std::set<std::size_t> active_before;             // a finished behavior not counted
    std::set<std::size_t> active;                    // by now
    std::vector<std::vector<std::size_t>> tasks_of;  // of each behavior, since its activation
    std::set<std::size_t> excluded;
    int first_level = 0;
    int level = 0;  // of protection
    Integer space;
    nlohmann::ordered_json changes = nlohmann::ordered_json::array();
    std::vector<std::size_t> lost;  // active before the event; could not be activated again
  };

  std::optional<Due> next_due() const;
  std::optional<Microseconds> deadline(std::size_t task) const;
  void run_due(const Due& due);

  void run_start(const Event& event);
  void run_stop(const Event& event);
  // `task`: that by which a script names the behavior, or none.
  void run_finish(const char* origin, std::size_t behavior, Cause cause, std::size_t task = none);
  void run_situation(const Event& event);
  void set_situation(const Situation& situation);
  void finish_what_does_not_fit();
  void run_fault(const Event& event);
  void run_repair(const Event& event);
  void run_reactive_start(std::size_t task);
  bool is_blocked(std::size_t task) const;
  bool is_blocked_by(std::size_t task, std::size_t list) const;
  bool counts_against(std::size_t task, std::size_t other) const;

  void reconsider(const char* origin, const std::set<std::size_t>& groups);
  bool improves(const Assignment& values) const;
  std::set<std::size_t> may_need(std::size_t task) const;
  void remember_failure(std::size_t behavior);
  std::set<std::size_t> forgive(std::size_t task);
  bool excludes_each_other(std::size_t a, std::size_t b) const;

  // Solves and applies; adds the results to the record, completes it, and lets the behaviors that
  // were lost finish.
  void coordinate(nlohmann::ordered_json record, const Trigger& trigger);
  bool makes_worse(const Transition& transition, const Assignment& values) const;
  std::set<std::size_t> find_differing(const Transition& transition,
                                       const std::optional<Solution>& solution) const;
  Transition begin(const Trigger& trigger) const;
  std::optional<Solution> solve_at_some_level(Transition& transition) const;
  Problem problem(const Transition& transition) const;
  std::vector<std::size_t> domain(const Transition& transition, std::size_t task) const;
  std::vector<std::size_t> selectable(const Transition& transition, std::size_t task) const;
  bool is_protected(const Transition& transition, std::size_t task) const;
  bool may_not_improve(const Transition& transition, std::size_t task) const;
  std::vector<ActiveRequest> active_requests(const Transition& transition) const;
  std::vector<ActiveRequest> suspended_requests(const Transition& transition) const;
  const char* activation_cause(const Transition& transition,
                               const std::vector<std::size_t>& tasks) const;

  // The behavior whose activation failed, if one did.
  std::optional<std::size_t> apply(Transition& transition, const Assignment& values);
  void roll_back(Transition& transition);
  const char* deactivation_cause(const Transition& transition, const Assignment& values,
                                 const std::vector<std::size_t>& tasks) const;
  std::optional<int> priority_before(const std::vector<std::size_t>& tasks) const;
  std::optional<int> priority_after(const Transition& transition,
                                    const std::vector<std::size_t>& tasks) const;
  void deactivate(Transition& transition, std::size_t behavior, const std::string& cause,
                  std::optional<int> priority);
  bool activate(Transition& transition, std::size_t behavior, const std::vector<std::size_t>& tasks,
                const std::string& cause, std::optional<int> priority);
  void add_change(Transition& transition, const std::string& operation, std::size_t behavior,
                  const std::vector<std::size_t>& tasks, const std::string& cause,
                  std::optional<int> priority, bool success) const;
  bool restarts(const Transition& transition, const Assignment& values) const;
  std::vector<std::size_t> stopped_tasks(const Assignment& values) const;
  void commit(const Transition& transition, const Assignment& values);
  void update_queue(const Transition& transition, const Assignment& before);
  void update_waiting(std::size_t group);
  std::map<std::size_t, bool> queued_tasks(std::size_t group) const;
  void join_queue(std::size_t task);
  void join_queue_by_group(std::size_t group);

  nlohmann::ordered_json variables_json() const;
  nlohmann::ordered_json objective(const Transition& transition, const Solution& solution) const;
  nlohmann::ordered_json new_record(const std::string& origin, Verb verb);
  void complete(nlohmann::ordered_json record, const std::string& outcome);
  void complete_unsolved(nlohmann::ordered_json record, const std::string& outcome);
  std::vector<std::size_t> tasks_performed(const Assignment& values, std::size_t behavior) const;
  bool is_active(std::size_t behavior) const;
  const std::string& task_name(std::size_t task) const;
  const std::string& behavior_name(std::size_t behavior) const;
  void count(const std::string& what) const;
  void count_if(bool holds, const std::string& what) const;

  std::shared_ptr<const CatalogFacts> facts_;
  Statistics* statistics_;
  Microseconds reactive_delay_;
  State state_;
  std::vector<std::size_t> variables_;  // the value of each
  std::vector<bool> own_;               // of each behavior: what the script says
  std::vector<bool> faulty_;
  std::vector<std::optional<Microseconds>> queue_;  // due time of each task in Q
  std::set<std::size_t> waiting_;                   // W
  std::set<std::size_t> failed_;                    // X
  std::set<std::size_t> forgiven_;                  // out of X for the present event
  std::vector<Microseconds> activated_at_;          // of each behavior: its last activation
  std::vector<Microseconds> taken_at_;              // of each task: when it took its behavior
  Microseconds now_ = 0;
  std::int64_t event_number_ = 0;
  bool keeps_answers_ = false;
  std::map<std::int64_t, Answer> answers_;
  std::vector<std::shared_ptr<const CatalogFacts>> variants_;
  std::map<std::int64_t, std::set<std::size_t>> differing_;
  nlohmann::ordered_json events_ = nlohmann::ordered_json::array();
};

// The "events" of a whole script. Statistics may be null.
nlohmann::ordered_json run_oracle(const Catalog& catalog, const Script& script,
                                  Statistics* statistics);

}  // namespace cbc::oracle
