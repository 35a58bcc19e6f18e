// Solves one question, as model.py writes it for Gecode:
//
//     gecode_peer FILE SECONDS
//
// The first line of the output is `optimal`, `infeasible` or `timeout` and the CPU time from the
// posting of the model to the end of the search, in seconds; the second one has the best values by
// place, from 0.

#include <algorithm>
#include <ctime>
#include <fstream>
#include <gecode/int.hh>
#include <gecode/minimodel.hh>
#include <gecode/search.hh>
#include <iomanip>
#include <iostream>
#include <memory>
#include <vector>

namespace {

namespace gc = Gecode;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Value {
  int cost = 0;
  int changes = 0;
  std::vector<int> requires_tasks;
};

struct Task {
  bool is_forced = false;
  bool is_root = false;         ///< may run though nothing requires it
  bool counts_as_idle = false;  ///< can start without a request
  int changes_if_stopped = 0;
  std::vector<Value> values;
};

struct Drop {
  int task = 0;
  int rise = 0;  ///< how far the protection level goes up if the task stops
};

struct Question {
  std::vector<Task> tasks;  ///< from the highest level to the lowest
  std::vector<std::vector<int>> exclusive;
  std::vector<Drop> droppable;  ///< the most important first
};

std::vector<int> read_list(std::istream& in) {
  std::size_t count = 0;
  in >> count;
  std::vector<int> list(count);
  for (int& one : list) in >> one;
  return list;
}

Question read_question(std::istream& in) {
  Question question;
  std::size_t count = 0;
  in >> count;
  question.tasks.resize(count);
  for (Task& task : question.tasks) {
    in >> task.is_forced >> task.is_root >> task.counts_as_idle >> task.changes_if_stopped >> count;
    task.values.resize(count);
    for (Value& value : task.values) {
      in >> value.cost >> value.changes;
      value.requires_tasks = read_list(in);
    }
  }
  in >> count;
  question.exclusive.resize(count);
  for (auto& list : question.exclusive) list = read_list(in);
  in >> count;
  question.droppable.resize(count);
  for (Drop& drop : question.droppable) in >> drop.task >> drop.rise;
  return question;
}

/// Each solution is better than the one before in the lexicographic order of `objective`.
class Model : public gc::Space {
 public:
  explicit Model(const Question& question)
      : values_(*this, static_cast<int>(question.tasks.size())) {
    const int count = values_.size();
    gc::BoolVarArgs runs(*this, count, 0, 1);
    std::vector<gc::BoolVarArgs> required_by(question.tasks.size());
    gc::IntVarArgs costs;
    gc::IntVarArgs changes;
    gc::BoolVarArgs idle;
    for (int x = 0; x < count; ++x) {
      const Task& task = question.tasks[static_cast<std::size_t>(x)];
      values_[x] = gc::IntVar(*this, 0, static_cast<int>(task.values.size()));
      gc::rel(*this, values_[x], gc::IRT_GR, 0, runs[x]);
      if (task.is_forced) gc::rel(*this, values_[x], gc::IRT_GR, 0);
      gc::IntArgs cost_of{0};
      gc::IntArgs changes_of{task.changes_if_stopped};
      for (std::size_t v = 0; v < task.values.size(); ++v) {
        const Value& value = task.values[v];
        cost_of << value.cost;
        changes_of << value.changes;
        if (value.requires_tasks.empty()) continue;
        const gc::BoolVar chosen = gc::expr(*this, values_[x] == static_cast<int>(v) + 1);
        for (const int needed : value.requires_tasks) {
          gc::rel(*this, chosen, gc::IRT_LQ, runs[needed]);
          required_by[static_cast<std::size_t>(needed)] << chosen;
        }
      }
      costs << look_up(cost_of, values_[x]);
      changes << look_up(changes_of, values_[x]);
      if (task.counts_as_idle) idle << runs[x];
    }
    for (int x = 0; x < count; ++x) {
      const Task& task = question.tasks[static_cast<std::size_t>(x)];
      const gc::BoolVarArgs& reasons = required_by[static_cast<std::size_t>(x)];
      if (!task.is_root) gc::rel(*this, gc::BOT_OR, reasons, runs[x]);
    }
    for (const auto& list : question.exclusive) {
      gc::BoolVarArgs together;
      for (const int x : list) together << runs[x];
      gc::linear(*this, together, gc::IRT_LQ, 1);
    }
    post_objective(question, runs, costs, idle, changes);
    // The tasks of the requests first, then each level below what requires it.
    gc::BoolVarArgs requested;
    for (const Drop& drop : question.droppable) requested << runs[drop.task];
    if (requested.size() > 0) {
      gc::branch(*this, requested, gc::BOOL_VAR_NONE(), gc::BOOL_VAL_MAX());
    }
    gc::branch(*this, values_, gc::INT_VAR_AFC_SIZE_MAX(0.99), gc::INT_VAL_MIN());
  }

  Model(Model& other) : gc::Space(other) {
    values_.update(*this, other.values_);
    objective_.update(*this, other.objective_);
  }
  gc::Space* copy() override { return new Model(*this); }

  void constrain(const gc::Space& best) override {
    const auto& other = static_cast<const Model&>(best);
    gc::IntVarArgs values;
    for (int i = 0; i < objective_.size(); ++i) {
      const int value = other.objective_[i].val();
      values << gc::IntVar(*this, value, value);
    }
    gc::rel(*this, gc::IntVarArgs(objective_), gc::IRT_LE, values);
  }

  [[nodiscard]] std::vector<int> values() const {
    std::vector<int> values;
    values.reserve(static_cast<std::size_t>(values_.size()));
    for (int i = 0; i < values_.size(); ++i) values.push_back(values_[i].val());
    return values;
  }

 private:
  gc::IntVar look_up(const gc::IntArgs& numbers, const gc::IntVar& index) {
    gc::IntVar result(*this, *std::min_element(numbers.begin(), numbers.end()),
                      *std::max_element(numbers.begin(), numbers.end()));
    gc::element(*this, numbers, index, result);
    return result;
  }

  void post_objective(const Question& question, const gc::BoolVarArgs& runs,
                      const gc::IntVarArgs& costs, const gc::BoolVarArgs& idle,
                      const gc::IntVarArgs& changes) {
    gc::IntVarArgs objective;
    gc::BoolVarArgs dropped;
    gc::IntVarArgs rises;
    for (const Drop& drop : question.droppable) {
      dropped << gc::expr(*this, !runs[drop.task]);
      if (drop.rise > 0) rises << gc::expr(*this, dropped[dropped.size() - 1] * drop.rise);
    }
    if (rises.size() > 0) objective << gc::expr(*this, gc::max(rises));
    if (dropped.size() > 0) objective << gc::expr(*this, gc::sum(dropped));
    for (const gc::BoolVar& one : dropped) objective << gc::channel(*this, one);
    objective << gc::expr(*this, gc::sum(costs)) << gc::expr(*this, gc::sum(idle))
              << gc::expr(*this, gc::sum(changes));
    objective_ = gc::IntVarArray(*this, objective);
  }

  gc::IntVarArray values_;
  gc::IntVarArray objective_;
};

class CpuStop : public gc::Search::Stop {
 public:
  explicit CpuStop(double end) : end_(end) {}
  bool stop(const gc::Search::Statistics& /*statistics*/,
            const gc::Search::Options& /*options*/) override {
    return cpu_seconds() > end_;
  }

 private:
  const double end_;
};

void solve(const Question& question, double limit) {
  const double begin = cpu_seconds();
  CpuStop stop(begin + limit);
  gc::Search::Options options;
  options.stop = &stop;
  options.threads = 1;
  options.cutoff = gc::Search::Cutoff::luby(250);
  options.nogoods_limit = 128;
  std::vector<int> best;
  bool has_solution = false;
  const auto model = std::make_unique<Model>(question);
  gc::RBS<Model, gc::BAB> search(model.get(), options);
  while (const std::unique_ptr<Model> solution{search.next()}) {
    best = solution->values();
    has_solution = true;
  }
  const double end = cpu_seconds();
  const bool is_cut = search.stopped();
  std::cout << (is_cut         ? "timeout"
                : has_solution ? "optimal"
                               : "infeasible")
            << ' ' << std::fixed << std::setprecision(6) << end - begin << '\n';
  for (const int value : best) std::cout << value << ' ';
  std::cout << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::ifstream file(argv[1]);
  const Question question = read_question(file);
  if (!file) return 2;
  solve(question, std::atof(argv[2]));
  return 0;
}
