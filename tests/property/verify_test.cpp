// The exploration of random small catalogs must find what the plain search finds: the same numbers,
// verdicts and scripts, with any number of jobs. CBC_SEED and CBC_PROPERTY_CASES are as in
// property_test.cpp.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "compiled_text.h"
#include "condition_text.h"
#include "demand.h"
#include "explore/properties/explore.h"
#include "plain_exploration.h"
#include "question_generator.h"
#include "random.h"
#include "random_cases.h"
#include "statistics.h"
#include "support/read_file.h"
#include "verify_case.h"

namespace cbc::plain::verify_test {
namespace {

using oracle::demand;

constexpr std::uint64_t default_cases = 500;
constexpr std::uint64_t most_states = 1500;
constexpr std::uint64_t questions_of_each = 5;
constexpr std::uint64_t states_of_each = 1000;

template <typename Number>
std::string list_of(const std::vector<Number>& numbers) {
  std::string text;
  for (const Number number : numbers) text += " " + std::to_string(number);
  return text;
}

std::string list_of(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& depths) {
  std::string text;
  for (const auto& [index, depth] : depths) {
    text += " " + std::to_string(index) + ":" + std::to_string(depth);
  }
  return text;
}

std::string list_of(const std::vector<Exploration::Together>& pairs) {
  std::string text;
  for (const Exploration::Together& pair : pairs) {
    text += " " + std::to_string(pair.a) + "+" + std::to_string(pair.b) + ":" +
            std::to_string(pair.depth);
  }
  return text;
}

/// What runs, when, how and where.
std::string list_of(const VerifyCase& sample, const std::vector<ReachableOutcome>& outcomes) {
  std::string text;
  for (const ReachableOutcome& outcome : outcomes) {
    text += list_of(outcome.running) + " with";
    for (const auto& [variable, value] : outcome.situation.variables) {
      text += " " + std::to_string(variable) + "=" + std::to_string(value);
    }
    for (const auto& [behavior, available] : outcome.situation.behaviors) {
      text += " " + std::to_string(behavior) + (available ? "+" : "-");
    }
    text +=
        " without" + list_of(outcome.faulty) + " by\n" + text_of(sample.catalog, outcome.script);
  }
  return text;
}

/// Everything that two explorations have to agree on.
std::vector<std::pair<std::string, std::string>> parts_of(const VerifyCase& sample,
                                                          const Exploration& result) {
  std::vector<std::pair<std::string, std::string>> parts = {
      {"error", result.error ? "yes" : "no"},
  };
  if (result.error) return parts;
  parts.insert(parts.end(), {{"groups", list_of(result.groups)},
                             {"complete", result.complete ? "yes" : "no"},
                             {"states", std::to_string(result.states)},
                             {"states at depth", list_of(result.states_at_depth)},
                             {"depth", std::to_string(result.depth)},
                             {"transitions", std::to_string(result.transitions)},
                             {"runs", list_of(result.runs)},
                             {"active", list_of(result.active)},
                             {"start refused", list_of(result.start_refused)},
                             {"together", list_of(result.together)},
                             {"outcomes", list_of(sample, result.outcomes.value())},
                             {"verdicts", std::to_string(result.verdicts.size())}});
  for (std::size_t i = 0; i < result.verdicts.size(); ++i) {
    parts.emplace_back(sample.question.properties[i].name,
                       text_of(sample.catalog, result.verdicts[i]));
  }
  return parts;
}

void demand_same(const VerifyCase& sample, const Exploration& result, const Exploration& expected,
                 const std::string& what) {
  const auto found = parts_of(sample, result);
  const auto wanted = parts_of(sample, expected);
  std::string differences;
  for (std::size_t i = 0; i < std::min(wanted.size(), found.size()); ++i) {
    if (wanted[i] == found[i]) continue;
    differences += wanted[i].first + ": " + found[i].second + ", not " + wanted[i].second + "\n";
  }
  demand(differences.empty(), what + "\n" + differences);
  demand(wanted.size() == found.size(), what + "\nanother number of parts");
}

/// What nothing decides before all states were visited.
const Property& undecided_to_the_end() {
  static const Property property = [] {
    Property always;
    always.kind = Property::Kind::always;
    return always;
  }();
  return property;
}

/// Visits all states, whatever the properties are, but where they have a mark.
Exploration explore_all(const VerifyCase& sample, ExplorationOptions options) {
  options.outcomes = true;
  std::vector<const Property*> properties = sample.properties();
  properties.push_back(&undecided_to_the_end());
  Exploration result = explore(sample.catalog, sample.question.groups, sample.question.assumptions,
                               properties, options);
  result.verdicts.pop_back();
  return result;
}

void compare(const VerifyCase& sample, const Exploration& expected, unsigned jobs) {
  ExplorationOptions options;
  options.jobs = jobs;
  demand_same(sample, explore_all(sample, options), expected, std::to_string(jobs) + " jobs");
}

/// Compares with the search that merges orders of requests, in all but the counts. Returns whether
/// it merged any.
bool compare_merged(const VerifyCase& sample, const Exploration& expected) {
  ExplorationOptions options;
  options.reduce = true;
  Exploration result = explore_all(sample, options);
  demand(result.states <= expected.states, "merged, there are more states");
  demand(result.depth <= expected.depth, "merged, states are deeper");
  const bool has_merged = result.states < expected.states;
  result.states = expected.states;
  result.states_at_depth = expected.states_at_depth;
  result.depth = expected.depth;
  result.transitions = expected.transitions;
  demand_same(sample, result, expected, "merged");
  return has_merged;
}

/// The entries up to a depth, which is their last part.
template <typename Entries, typename DepthOf>
Entries up_to(std::uint32_t depth, const Entries& entries, DepthOf&& depth_of) {
  Entries kept;
  std::copy_if(entries.begin(), entries.end(), std::back_inserter(kept),
               [&](const auto& entry) { return depth_of(entry) <= depth; });
  return kept;
}

/// What both know who have expanded all states up to a depth.
Exploration beginning_of(const VerifyCase& sample, Exploration result, std::uint32_t depth) {
  const auto second = [](const auto& entry) { return entry.second; };
  result.complete = false;
  result.states = 0;
  result.transitions = 0;
  result.depth = depth;
  result.states_at_depth.resize(depth + 1);
  result.runs = up_to(depth, result.runs, second);
  result.active = up_to(depth, result.active, second);
  result.start_refused = up_to(depth, result.start_refused, second);
  result.together =
      up_to(depth, result.together, [](const Exploration::Together& entry) { return entry.depth; });
  result.outcomes = up_to(depth, *result.outcomes,
                          [](const ReachableOutcome& outcome) { return outcome.script.size(); });
  for (std::size_t i = 0; i < result.verdicts.size(); ++i) {
    Verdict& verdict = result.verdicts[i];
    const Property::Kind kind = sample.question.properties[i].kind;
    const bool ends_with_move =
        kind == Property::Kind::can_start || kind == Property::Kind::keeps_running;
    const std::size_t length =
        verdict.script.size() - (ends_with_move && verdict.has_script ? 1 : 0);
    const bool needs_all = kind == Property::Kind::always_possible;
    if (verdict.has_script && length <= depth && !needs_all) continue;
    // If one of them is complete, the other one cannot know.
    verdict = {};
  }
  return result;
}

/// Compares with the search that ends once all is decided. Returns whether it did.
bool compare_decided(const VerifyCase& sample, const Exploration& expected) {
  ExplorationOptions options;
  options.outcomes = true;
  const Exploration result = explore(sample.catalog, sample.question.groups,
                                     sample.question.assumptions, sample.properties(), options);
  if (result.complete) {
    demand_same(sample, result, expected, "nothing was decided early");
    return false;
  }
  demand(result.decided && !result.end, "it ended for another reason");
  demand(std::all_of(result.verdicts.begin(), result.verdicts.end(),
                     [](const Verdict& verdict) { return verdict.has_script; }),
         "it ended although not all is decided");
  const auto texts = [&](const Exploration& exploration) {
    std::string text;
    for (const Verdict& one : exploration.verdicts) text += text_of(sample.catalog, one);
    return text;
  };
  demand(texts(result) == texts(expected), "decided early, other verdicts: " + texts(result));
  // The moves of the last depth may not have been made.
  if (result.depth == 0) return true;
  const std::uint32_t depth = result.depth - 1;
  Exploration shorter = result;
  shorter.states_at_depth.resize(result.depth);
  demand_same(sample, beginning_of(sample, shorter, depth), beginning_of(sample, expected, depth),
              "decided early, other facts");
  return true;
}

/// Compares searches that ended at a limit. Returns the depth that was compared.
std::uint32_t compare_beginnings(const VerifyCase& sample, const Exploration& expected) {
  ExplorationOptions options;
  options.budget.max_states = expected.states;
  const auto explore_with = [&](unsigned jobs) {
    options.jobs = jobs;
    return explore_all(sample, options);
  };
  const Exploration result = explore_with(1);
  demand_same(sample, explore_with(3), result, "3 jobs, and not 1");
  if (!result.complete) {
    for (const Verdict& verdict : result.verdicts) {
      const bool is_decided = verdict.result != Verdict::Result::undecided;
      demand(is_decided == verdict.has_script, "a verdict without reason");
    }
  }
  const std::uint32_t depth = std::min(expected.depth, result.depth);
  demand_same(sample, beginning_of(sample, result, depth), beginning_of(sample, expected, depth),
              "up to depth " + std::to_string(depth));
  return depth;
}

/// What the states of outcomes are like.
void count_outcomes(const Exploration& expected, oracle::Statistics& statistics) {
  for (const ReachableOutcome& outcome : *expected.outcomes) {
    const auto count = [&](const char* what, bool happened) {
      if (happened) statistics.count(what);
    };
    const auto has = [&](Move::Kind kind) {
      return std::any_of(outcome.script.begin(), outcome.script.end(),
                         [kind](const Move& move) { return move.kind == kind; });
    };
    statistics.count("outcome");
    count("outcome after three moves", outcome.script.size() >= 3);
    count("outcome with a fault", !outcome.faulty.empty());
    count("outcome by a situation", has(Move::Kind::variable) || has(Move::Kind::own));
    count("outcome by the queue", has(Move::Kind::due));
    count("outcome of several tasks", outcome.running.size() > 1);
  }
}

void count_verdict(const Property& property, const Verdict& verdict,
                   oracle::Statistics& statistics) {
  const std::string kind = property.after ? "scoped" : std::string(name_of(property.kind));
  statistics.count(kind + (verdict.result == Verdict::Result::proved ? " proved" : " violated"));
  if (verdict.is_vacuous) statistics.count("vacuous");
}

bool is_nested(const StateCondition& part) {
  return part.kind == StateCondition::Kind::negated || part.kind == StateCondition::Kind::any ||
         part.kind == StateCondition::Kind::all;
}

std::size_t depth_of(const StateCondition& condition) {
  std::size_t depth = 0;
  for (const StateCondition& part : condition.parts) {
    if (!is_nested(part)) continue;
    for (const StateCondition& inner : part.parts) depth = std::max(depth, 1 + depth_of(inner));
  }
  return depth;
}

/// Which forms of conditions the property has.
std::set<std::string> forms_of(const Property& property) {
  std::set<std::string> forms;
  const auto note = [&](bool has, const char* what) {
    if (has) forms.insert(what);
  };
  const auto look_at = [&](const StateCondition& condition) {
    const auto& parts = condition.parts;
    note(condition.kind == StateCondition::Kind::negated, "not");
    note(condition.kind == StateCondition::Kind::any && parts.size() > 1, "any");
    note(condition.kind == StateCondition::Kind::all &&
             std::any_of(
                 parts.begin(), parts.end(),
                 [](const StateCondition& part) { return part.kind == StateCondition::Kind::all; }),
         "all");
    note(condition.kind == StateCondition::Kind::none_faulty, "none faulty");
    note(condition.kind == StateCondition::Kind::suspended, "suspended");
    note(condition.kind == StateCondition::Kind::failed, "failed");
    note(condition.behaviors.size() > 1, "list of behaviors");
    note(condition.values.size() > 1, "list of values");
  };
  for_each_condition(property.condition, look_at);
  note(depth_of(property.condition) > 1, "nested twice");
  if (property.when) {
    for_each_condition(*property.when, look_at);
    note(depth_of(*property.when) > 1, "nested twice");
    note(property.kind == Property::Kind::can_start, "can_start when");
  }
  return forms;
}

/// With both answers: what holds always or never says little about how it is tested.
void count_forms(const VerifyCase& sample, const Exploration& result,
                 oracle::Statistics& statistics) {
  for (std::size_t i = 0; i < result.verdicts.size(); ++i) {
    const std::string answer = result.verdicts[i].has_script ? ", met" : ", not met";
    for (const std::string& form : forms_of(sample.question.properties[i])) {
      statistics.count(form + answer);
    }
  }
}

/// What the reader refuses as impossible must be so. What it reads is explored in place of what was
/// written.
void read_properties_again(VerifyCase& sample, const Exploration& expected,
                           oracle::Statistics& statistics) {
  for (std::size_t i = 0; i < expected.verdicts.size(); ++i) {
    Property& property = sample.question.properties[i];
    const bool is_met = expected.verdicts[i].has_script;
    const bool is_demanded =
        property.kind == Property::Kind::never || property.kind == Property::Kind::reachable;
    if ((is_demanded && is_called_impossible(sample.catalog, property.condition)) ||
        (property.when && is_called_impossible(sample.catalog, *property.when))) {
      demand(!is_met, "called impossible: " + property.name);
      statistics.count("called impossible");
    }
    if (auto read = read_again(sample.catalog, property)) {
      property = std::move(*read);
      statistics.count("read again");
    }
  }
}

void run_case_of(std::uint64_t seed, bool with_keys, oracle::Results& results) {
  VerifyCase sample;
  try {
    sample = generate_verify_case(seed, with_keys);
    const Exploration expected =
        explore_plainly(sample.catalog, sample.question.groups, sample.question.assumptions,
                        sample.properties(), most_states);
    read_properties_again(sample, expected, results.statistics);
    if (expected.error || expected.complete) {
      compare(sample, expected, 1);
      compare(sample, expected, 3);
      if (!expected.error && compare_merged(sample, expected)) results.statistics.count("merged");
      if (!expected.error && compare_decided(sample, expected)) {
        results.statistics.count("decided early");
      }
      for (std::size_t i = 0; i < expected.verdicts.size(); ++i) {
        count_verdict(sample.question.properties[i], expected.verdicts[i], results.statistics);
      }
      results.statistics.count(expected.error ? "excluded first state" : "compared");
      if (!expected.error) count_outcomes(expected, results.statistics);
      if (!expected.error) count_forms(sample, expected, results.statistics);
    } else {
      compare_beginnings(sample, expected);
      results.statistics.count("compared up to a limit");
    }
  } catch (const std::exception& error) {
    results.faults.push_back({seed, "seed " + std::to_string(seed) + "\n--- catalog\n" +
                                        text_of(sample) + "--- fault\n" + error.what() + "\n"});
  }
}

const oracle::LowerBound lower_bounds[] = {
    {"compared", 600},
    {"compared up to a limit", 80},
    {"excluded first state", 10},
    {"merged", 20},
    {"decided early", 20},
    {"outcome", 5000},
    {"outcome after three moves", 2500},
    {"outcome with a fault", 300},
    {"outcome by a situation", 500},
    {"outcome by the queue", 2500},
    {"outcome of several tasks", 3000},
    {"keeps_running proved", 20},
    {"keeps_running violated", 20},
    {"always_possible proved", 20},
    {"always_possible violated", 20},
    {"scoped proved", 20},
    {"scoped violated", 20},
    {"vacuous", 20},
    {"not, met", 200},
    {"not, not met", 200},
    {"any, met", 200},
    {"any, not met", 200},
    {"all, met", 200},
    {"all, not met", 200},
    {"nested twice, met", 200},
    {"nested twice, not met", 200},
    {"none faulty, met", 100},
    {"none faulty, not met", 80},
    {"list of behaviors, met", 100},
    {"list of behaviors, not met", 50},
    {"list of values, met", 50},
    {"list of values, not met", 10},
    {"read again", 1500},
    {"called impossible", 50},
    {"can_start when, met", 30},
    {"can_start when, not met", 50},
};

void run_case(std::uint64_t seed, oracle::Results& results) { run_case_of(seed, false, results); }

void run_case_with_keys(std::uint64_t seed, oracle::Results& results) {
  run_case_of(seed, true, results);
}

const oracle::LowerBound bounds_with_keys[] = {
    {"compared", 300},      {"compared up to a limit", 80},
    {"suspended, met", 50}, {"suspended, not met", 20},
    {"failed, met", 50},    {"failed, not met", 20},
};

TEST(Verify, FindsWhatThePlainSearchFinds) {
  oracle::run_random_cases(default_cases, run_case, lower_bounds);
}

TEST(Verify, FindsWhatThePlainSearchFindsWithFurtherKeys) {
  oracle::run_random_cases(default_cases, run_case_with_keys, bounds_with_keys);
}

/// Random questions about catalogs that are too large to be searched plainly.
TEST(Verify, BeginsAsThePlainSearchOnLargerCatalogs) {
  std::size_t cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CBC_SOURCE_DIR "/catalogs")) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() != ".yaml" || path.stem().has_extension()) continue;
    VerifyCase sample;
    sample.catalog = oracle::compile_yaml(test::read_file(path)).value();
    for (std::uint64_t seed = 1; seed <= questions_of_each; ++seed) {
      oracle::Random random(seed);
      sample.question = generate_question(random, sample.catalog);
      const Exploration expected =
          explore_plainly(sample.catalog, sample.question.groups, sample.question.assumptions,
                          sample.properties(), states_of_each);
      SCOPED_TRACE(path.filename().string() + ", " + std::to_string(seed));
      try {
        if (expected.complete) {
          compare(sample, expected, 3);
          compare_merged(sample, expected);
        } else if (!expected.error) {
          compare_beginnings(sample, expected);
        }
        ++cases;
      } catch (const std::exception& error) {
        ADD_FAILURE() << text_of(sample) << error.what();
      }
    }
  }
  EXPECT_GE(cases, 8 * questions_of_each);
}

}  // namespace
}  // namespace cbc::plain::verify_test
