// Random catalogs: the minimal cut sets of every task must be those that a look at every set of
// behaviors and every assignment finds, and the fault tree, as it is written, must be true for
// exactly the faults that leave no assignment. CBC_SEED and CBC_PROPERTY_CASES are as in
// lint_property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <gtest/gtest.h>

#include "compiled_text.h"
#include "demand.h"
#include "enumeration.h"
#include "lint_generator.h"
#include "lint_oracle.h"
#include "random.h"
#include "random_cases.h"
#include "runtime/compiled/compiled_catalog.h"
#include "statistics.h"
#include "verify/engine/cut_sets.h"
#include "verify/engine/fault_tree.h"
#include "verify/report/open_psa.h"
#include "yaml_text.h"

namespace cbc::oracle::cut_sets_property_test {
namespace {

constexpr std::uint64_t default_cases = 1000;

/// Behaviors of the model, one bit each.
using Set = std::uint64_t;

constexpr Set bit(std::size_t behavior) { return Set{1} << behavior; }

/// A fault tree, read from its XML.
class WrittenTree {
 public:
  explicit WrittenTree(const std::string& xml) {
    std::istringstream stream(xml);
    boost::property_tree::ptree document;
    boost::property_tree::read_xml(stream, document);
    for (const auto& [element, content] : document.get_child("opsa-mef.define-fault-tree")) {
      if (element != "define-gate") continue;
      const std::string name = name_of(content);
      if (top_.empty()) top_ = name;
      for (const auto& [formula, inputs] : content) {
        if (formula == "<xmlattr>" || formula == "label") continue;
        demand(formulas_.emplace(name, std::pair(formula, inputs)).second,
               "a gate has two formulas: " + name);
      }
    }
    for (const auto& [element, content] : document.get_child("opsa-mef.model-data")) {
      demand(element == "define-basic-event", "what is " + element);
      demand(events_.insert(name_of(content)).second, "an event is defined twice");
    }
  }

  /// Whether the first gate is true; `is_faulty`: of the name of a behavior.
  template <typename IsFaulty>
  bool is_lost(const IsFaulty& is_faulty) const {
    std::map<std::string, bool> known;
    return value_of_gate(top_, is_faulty, known);
  }

 private:
  using Tree = boost::property_tree::ptree;

  static std::string name_of(const Tree& element) {
    return element.get<std::string>("<xmlattr>.name");
  }

  template <typename IsFaulty>
  bool value_of_gate(const std::string& name, const IsFaulty& is_faulty,
                     std::map<std::string, bool>& known) const {
    const auto found = known.find(name);
    if (found != known.end()) return found->second;
    const auto& [formula, inputs] = formulas_.at(name);
    bool value = formula == "and";
    if (formula == "and" || formula == "or") {
      std::size_t count = 0;
      for (const auto& [kind, input] : inputs) {
        const bool one = value_of(kind, input, is_faulty, known);
        value = formula == "and" ? value && one : value || one;
        ++count;
      }
      demand(count > 1, "too few inputs of " + name);
    } else {
      value = value_of(formula, inputs, is_faulty, known);
    }
    return known[name] = value;
  }

  template <typename IsFaulty>
  bool value_of(const std::string& kind, const Tree& element, const IsFaulty& is_faulty,
                std::map<std::string, bool>& known) const {
    const std::string name = name_of(element);
    if (kind == "gate") return value_of_gate(name, is_faulty, known);
    if (kind == "house-event") return true;
    demand(kind == "basic-event" && events_.contains(name), "an event without a definition");
    constexpr std::string_view prefix = "fault-";
    return is_faulty(name.substr(prefix.size()));
  }

  std::string top_;
  std::map<std::string, std::pair<std::string, Tree>> formulas_;
  std::set<std::string> events_;
};

class Check {
 public:
  Check(const LintOracle& oracle, const CompiledCatalog& compiled, Random& random,
        Statistics& statistics)
      : oracle_(oracle),
        facts_(oracle.facts()),
        catalog_(facts_.catalog),
        compiled_(compiled),
        random_(random),
        statistics_(statistics) {}

  void check() {
    const std::optional<SituationPart> part = draw_situation();
    ruled_out_ = ruled_out_by(compiled_, part);
    for (std::size_t task = 0; task < catalog_.tasks.size(); ++task) {
      find_supports(task);
      check_cut_sets(task);
      check_fault_tree(task);
    }
  }

 private:
  TaskId id_of_task(std::size_t task) const {
    return compiled_.task_ids[*compiled_.find_task(catalog_.tasks[task].name)];
  }
  BehaviorId id_of_behavior(std::size_t behavior) const {
    return compiled_.behavior_ids[*compiled_.find_behavior(catalog_.behaviors[behavior].name)];
  }

  /// Sets `out_`, the behaviors that do not count, by the model.
  std::optional<SituationPart> draw_situation() {
    if (random_.percent(40)) return std::nullopt;
    statistics_.count("situation");
    SituationPart part;
    std::vector<std::optional<std::size_t>> fixed(catalog_.variables.size());
    for (std::size_t variable = 0; variable < fixed.size(); ++variable) {
      if (random_.percent(30)) continue;
      fixed[variable] = random_.below(catalog_.variables[variable].value_count());
      part.variables.push_back({*compiled_.find_variable(catalog_.variables[variable].name),
                                static_cast<std::uint32_t>(*fixed[variable])});
    }
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      for (const Condition& condition : catalog_.behaviors[behavior].situation) {
        const auto& value = fixed[condition.variable];
        const auto& fitting = condition.values;
        if (value && std::find(fitting.begin(), fitting.end(), *value) == fitting.end()) {
          out_ |= bit(behavior);
        }
      }
      if (!random_.percent(10)) continue;
      const bool available = random_.percent(30);
      if (!available) out_ |= bit(behavior);
      part.behaviors.push_back({id_of_behavior(behavior), available});
    }
    return part;
  }

  /// The active behaviors of each assignment that runs the task.
  void find_supports(std::size_t task) {
    std::set<Set> supports;
    const std::size_t group = facts_.group_of[task];
    static_cast<void>(oracle_.any(group, oracle_.all(group), [&](const Row& row) {
      if (row.values[task] == none) return false;
      Set active = 0;
      for (const std::size_t value : row.values) {
        if (value != none) active |= bit(value);
      }
      if ((active & out_) == 0) supports.insert(active);
      return false;
    }));
    supports_.assign(supports.begin(), supports.end());
  }

  bool is_impossible_without(Set faulty) const {
    return std::none_of(supports_.begin(), supports_.end(),
                        [faulty](Set support) { return (support & faulty) == 0; });
  }

  /// By size, then in catalog order.
  std::vector<std::vector<std::size_t>> minimal_cut_sets(std::size_t task,
                                                         std::size_t order) const {
    std::vector<std::size_t> behaviors;
    for (std::size_t behavior = 0; behavior < catalog_.behaviors.size(); ++behavior) {
      if (facts_.group_of_behavior(behavior) == facts_.group_of[task])
        behaviors.push_back(behavior);
    }
    std::vector<std::vector<std::size_t>> found;
    std::vector<std::vector<std::size_t>> sets{{}};
    for (std::size_t size = 0; size <= order; ++size) {
      std::vector<std::vector<std::size_t>> larger;
      for (const std::vector<std::size_t>& set : sets) {
        if (is_minimal_cut_set(set)) found.push_back(set);
        for (const std::size_t behavior : behaviors) {
          if (!set.empty() && behavior <= set.back()) continue;
          larger.push_back(set);
          larger.back().push_back(behavior);
        }
      }
      sets = std::move(larger);
    }
    return found;
  }

  bool is_minimal_cut_set(const std::vector<std::size_t>& set) const {
    Set faulty = 0;
    for (const std::size_t behavior : set) faulty |= bit(behavior);
    return is_impossible_without(faulty) &&
           std::none_of(set.begin(), set.end(), [&](std::size_t behavior) {
             return is_impossible_without(faulty & ~bit(behavior));
           });
  }

  void check_cut_sets(std::size_t task) {
    CutSetOptions options;
    options.order = static_cast<std::uint32_t>(random_.below(5));
    const CutSets found = find_cut_sets(compiled_, id_of_task(task), ruled_out_, options);
    std::vector<std::vector<BehaviorId>> expected;
    for (const std::vector<std::size_t>& set : minimal_cut_sets(task, options.order)) {
      std::vector<BehaviorId> ids;
      ids.reserve(set.size());
      for (const std::size_t behavior : set) ids.push_back(id_of_behavior(behavior));
      expected.push_back(std::move(ids));
      statistics_.count("cut set of " + std::to_string(set.size()));
    }
    demand(found.complete, "not complete");
    demand(found.sets == expected, "other cut sets of '" + catalog_.tasks[task].name + "'");
  }

  void check_fault_tree(std::size_t task) {
    const auto made = make_fault_tree(compiled_, id_of_task(task), ruled_out_);
    demand(std::holds_alternative<FaultTree>(made), "no fault tree");
    const auto& tree = std::get<FaultTree>(made);
    const WrittenTree written(open_psa_text(compiled_, tree));
    if (!tree.gates.empty()) statistics_.count(tree.ways > 0 ? "with ways" : "without ways");
    const std::size_t behaviors = catalog_.behaviors.size();
    const bool is_small = behaviors <= 7;
    const std::size_t sets = is_small ? std::size_t{1} << behaviors : 128;
    for (std::size_t i = 0; i < sets; ++i) {
      Set faulty = is_small ? i : random_.next();
      if (!is_small && random_.percent(50)) faulty &= random_.next();
      const bool lost = written.is_lost([&](const std::string& name) {
        return (faulty & bit(behaviors_by_name_.at(name))) != 0;
      });
      demand(lost == is_impossible_without(faulty),
             "the fault tree of '" + catalog_.tasks[task].name + "' is wrong");
    }
  }

  static std::map<std::string, std::size_t> by_name(const Catalog& catalog) {
    std::map<std::string, std::size_t> places;
    for (std::size_t i = 0; i < catalog.behaviors.size(); ++i)
      places[catalog.behaviors[i].name] = i;
    return places;
  }

  const LintOracle& oracle_;
  const CatalogFacts& facts_;
  const Catalog& catalog_;
  const CompiledCatalog& compiled_;
  Random& random_;
  Statistics& statistics_;
  const std::map<std::string, std::size_t> behaviors_by_name_ = by_name(catalog_);
  Set out_ = 0;
  std::vector<bool> ruled_out_;  ///< by BehaviorId
  std::vector<Set> supports_;
};

void add_situation(Catalog& catalog, Random& random) {
  const std::size_t count = random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    Variable variable{"V" + std::to_string(i), {}};
    if (random.percent(50)) variable.values = {"red", "green", "blue"};
    catalog.variables.push_back(variable);
  }
  for (Behavior& behavior : catalog.behaviors) {
    for (std::size_t variable = 0; variable < count; ++variable) {
      if (!random.percent(30)) continue;
      Condition condition{variable, {}};
      const std::size_t values = catalog.variables[variable].value_count();
      const std::size_t first = random.below(values);
      condition.values.push_back(first);
      if (values > 2 && random.percent(50)) condition.values.push_back((first + 1) % values);
      behavior.situation.push_back(condition);
    }
  }
}

void run_case(std::uint64_t seed, Results& results) {
  Random random(seed);
  Catalog catalog = generate_strict_catalog(random);
  add_situation(catalog, random);
  const std::string yaml = catalog_yaml(catalog, random);
  try {
    const CatalogFacts facts(catalog);
    const LintOracle oracle(facts);
    const std::optional<CompiledCatalog> compiled = compile_yaml(yaml);
    demand(compiled.has_value(), "not understood");
    Check(oracle, *compiled, random, results.statistics).check();
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" + yaml +
                                        "--- fault\n" + error.what() + "\n"});
  }
}

const LowerBound lower_bounds[] = {
    {"situation", 300},    {"cut set of 0", 300}, {"cut set of 1", 1000}, {"cut set of 2", 300},
    {"cut set of 3", 100}, {"with ways", 300},    {"without ways", 1000}, {"cut set of 4", 20},
};

TEST(CutSets, AreThoseOfEnumeration) { run_random_cases(default_cases, run_case, lower_bounds); }

}  // namespace
}  // namespace cbc::oracle::cut_sets_property_test
