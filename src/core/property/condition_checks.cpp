#include "core/property/condition_checks.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "core/diagnostic/rules.h"
#include "core/property/constraint_proof.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// What contradicts itself has no meaning.
constexpr Standing of_contradiction{Severity::error, true};

void append(std::vector<Impossible>& found, std::vector<Impossible> more) {
  found.insert(found.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

}  // namespace

ConditionChecks::ConditionChecks(const CompiledCatalog& catalog, const Assumptions* assumptions)
    : catalog_(catalog),
      assumptions_(assumptions),
      contradictions_(catalog),
      any_(catalog, {}, most_effort_of_assignments) {
  if (assumptions != nullptr) {
    assumed_.emplace(catalog, possible_states(catalog, *assumptions), most_effort_of_assignments);
  }
}

void ConditionChecks::check(const StateCondition& condition, bool is_denied, Reporter& reporter) {
  // What follows from requirements may well be what a property denies.
  ground_ = is_denied ? Ground::exclusions : Ground::catalog;
  reporter_ = &reporter;
  for (const Impossible& finding : judge(condition, {}, false)) {
    report(of_contradiction, "this can never hold: ", finding);
  }
}

std::vector<Impossible> ConditionChecks::judge(const StateCondition& condition, Parts parts,
                                               bool is_doubted) {
  contradictions_.add(condition, parts);
  any_.effort().spend(100 * parts.size());
  if (any_.effort().is_over()) return {};
  Parts affirmed = parts;
  std::erase_if(affirmed, [this](const Contradictions::Part& part) {
    const StateCondition& said = *part.condition;
    return said.kind == StateCondition::Kind::negated ||
           (said.task != none && catalog_.values[said.task].empty());
  });
  std::vector<Impossible> found = contradictions_.take_misplaced(affirmed, Ground::words);
  append(found, contradictions_.find(affirmed, Ground::words, any_, *reporter_));
  if (!found.empty()) return found;
  if (!is_doubted) {
    const std::vector<Impossible> doubts = doubts_about(parts);
    const bool is_denied = ground_ == Ground::exclusions;
    for (const Impossible& doubt : doubts) {
      report({is_denied ? Severity::note : Severity::warning},
             is_denied ? "this is ruled out already: " : "this can never hold: ", doubt);
    }
    is_doubted = !doubts.empty();
  }
  judge_alternatives(condition, parts, is_doubted, found);
  return found;
}

void ConditionChecks::judge_alternatives(const StateCondition& condition, const Parts& parts,
                                         bool is_doubted, std::vector<Impossible>& found) {
  if (condition.kind == StateCondition::Kind::all) {
    for (const StateCondition& part : condition.parts) {
      judge_alternatives(part, parts, is_doubted, found);
    }
  }
  if (condition.kind != StateCondition::Kind::any) return;
  std::vector<Impossible> impossible;
  bool is_possible = false;
  for (const StateCondition& alternative : condition.parts) {
    std::vector<Impossible> why = judge(alternative, parts, is_doubted);
    is_possible |= why.empty();
    append(impossible, std::move(why));
  }
  if (!is_possible) return append(found, std::move(impossible));
  for (const Impossible& finding : impossible) {
    report({Severity::warning}, "this can never hold: ", finding);
  }
}

/// What the catalog or the assumptions rule out.
std::vector<Impossible> ConditionChecks::doubts_about(Parts parts) {
  std::vector<Impossible> found = contradictions_.take_misplaced(parts, ground_);
  append(found, contradictions_.find(parts, ground_, any_, *reporter_));
  if (ground_ == Ground::exclusions) {
    // That several constraints rule it out is what the property is there to prove.
    std::erase_if(found, [](const Impossible& finding) { return finding.constraints != 1; });
  }
  if (assumptions_ == nullptr) return found;
  std::vector<Impossible> assumed = contradictions_.find(parts, ground_, *assumed_, *reporter_);
  for (Impossible& finding : assumed) finding.why += ", which 'assume' rules out";
  append(found, std::move(assumed));
  add_doubtful_priorities(parts, found);
  return found;
}

void ConditionChecks::add_doubtful_priorities(const Parts& parts,
                                              std::vector<Impossible>& found) const {
  for (const Contradictions::Part& part : parts) {
    const StateCondition& requested = *part.condition;
    if (requested.kind != StateCondition::Kind::requested || requested.priority == 0) continue;
    const auto start = std::find_if(
        assumptions_->start.begin(), assumptions_->start.end(),
        [&requested](const Assumptions::Start& entry) { return entry.task == requested.task; });
    const std::string name = quote(catalog_.name_of_task(requested.task));
    if (start == assumptions_->start.end()) {
      found.push_back({
          requested.range,
          concat("task ", name, " is never requested, as 'start' of 'assume' does not list it"),
      });
      continue;
    }
    const auto highest = std::max_element(start->priorities.begin(), start->priorities.end());
    if (highest == start->priorities.end() || requested.priority <= *highest) continue;
    found.push_back({requested.range, concat("'start' of 'assume' requests task ", name,
                                             " with at most priority ", *highest)});
  }
}

void ConditionChecks::report(const Standing& standing, const char* what,
                             const Impossible& finding) {
  reporter_->report_as(standing, rule::impossible_expectation, finding.range, what + finding.text(),
                       finding.notes);
}

}  // namespace cbc
