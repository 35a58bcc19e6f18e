#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/property/properties.h"
#include "core/report/blocks.h"
#include "core/script/runner.h"
#include "core/script/script.h"
#include "explore/properties/verification.h"
#include "runtime/compiled/compiled_catalog.h"
#include "verify/engine/effects.h"
#include "verify/engine/overrides.h"
#include "versions/lockstep/same_as.h"

// The reports of `cbc verify`.

namespace cbc {

/// A counterexample or witness, run as `cbc solve` runs scripts.
struct Replay {
  RunResult result;
  std::string text;           ///< event by event, as in the text of `cbc solve`
  std::size_t last_move = 0;  ///< where in it the last move begins
  std::string conflict;       ///< why the last scripted start was rejected, as in cbc.solve/1
  /// What led to the end, in sentences.
  std::vector<std::string> explanation;
  /// The reactive tasks that came due without an event, in sentences.
  std::vector<std::string> idle_queue;
};

/// Runs a script, which is a counterexample or a witness of the property.
[[nodiscard]] Replay replay_witness(const CompiledCatalog& catalog, const Witness& witness,
                                    const Property& property, const Style& style);

/// Runs a script of the difference between two catalogs. `last_move`: the time of the last move.
[[nodiscard]] Replay replay_difference(const CompiledCatalog& catalog, const Script& script,
                                       const Style& style, Microseconds last_move);

/// What was found out about a property, and its script.
struct ReportedAnswer {
  const PropertyAnswer* answer = nullptr;
  std::optional<Replay> replay;            ///< if there is a script
  std::optional<std::string> script_path;  ///< of the file that has it
};

/// An outcome, and its script.
struct ReportedOutcome {
  const ReachableOutcome* outcome = nullptr;
  std::size_t number = 1;  ///< in the order of the report
  Witness witness;
  std::vector<std::string> moves;          ///< of the script, in words
  std::optional<std::string> script_path;  ///< of the file that has it
};

/// What was found out under the assumptions of one property file, or under the default ones.
struct VerifyPart {
  std::unique_ptr<const PropertyFile> file;  ///< null: default assumptions, no properties
  Verification verification;
  std::vector<ReportedAnswer> answers;  ///< in the order of the file
  /// By exploration; only if outcomes were asked for.
  std::vector<std::vector<ReportedOutcome>> outcomes = {};

  /// Whether it is about the groups of the catalog, and not about properties.
  [[nodiscard]] bool is_about_groups() const { return file == nullptr || file->properties.empty(); }
};

/// Which effects make a check fail (--fail-on).
struct EffectLimit {
  std::string text;               ///< as given: "lost", "degraded:60"
  std::uint32_t thousandths = 0;  ///< of the suitability without faults that have to be left
};

/// The effects of faults on some tasks: all, or only that they are lost, which are their cut sets.
struct ReportedEffects {
  bool are_cut_sets = false;
  bool in_some_situation = false;  ///< see EffectOptions
  std::uint32_t order = 1;
  SituationPart situation;             ///< of every variable a value; of cut sets what is given
  std::vector<VariableValue> changes;  ///< those that were looked at
  std::vector<TaskEffects> tasks;      ///< in catalog order
  std::optional<EffectLimit> limit;

  [[nodiscard]] bool is_complete() const;
  /// The number of effects that exceed the limit, if there is one.
  [[nodiscard]] std::size_t count_failing(const CompiledCatalog& catalog) const;
  /// All effects on a task; with those that are none, unless they are cut sets.
  [[nodiscard]] std::vector<Effect> all_of(const CompiledCatalog& catalog,
                                           const TaskEffects& of_task) const;
};

/// Who gives way to whom.
struct ReportedOverrides {
  SituationPart situation;  ///< of every variable a value
  OverrideMatrix matrix;
};

/// An event that two catalogs decide differently, and its script, run on both.
struct ReportedDifference {
  const EventDifference* difference = nullptr;
  Replay with_old;
  Replay with_new;
  std::optional<std::string> script_path;      ///< of the file that has it
  std::optional<std::string> old_script_path;  ///< see EventDifference::old_text
};

/// How a catalog differs from an older one.
struct ReportedComparison {
  std::shared_ptr<const CompiledCatalog> old_catalog;
  Assumptions assumptions;  ///< about the new catalog
  CatalogComparison comparison;
  std::vector<ReportedDifference> differences;  ///< group by group
};

/// All that a call of `cbc verify` found out.
struct VerifyResult {
  std::shared_ptr<const CompiledCatalog> catalog;
  std::shared_ptr<const std::string> text;  ///< of the catalog; null if it was compiled
  std::vector<VerifyPart> parts;
  /// Of the tasks that start on request, in catalog order; only if a part is about groups.
  std::vector<TaskEffects> single_faults;
  /// What is given of the situation of all cut sets, and the situations that do not occur.
  SituationPart situation;
  std::vector<SituationPart> never;
  std::optional<ReportedEffects> effects;
  std::optional<ReportedOverrides> overrides;
  std::optional<ReportedComparison> same_as;
  Budget limits;

  /// Whether all properties are proved, and all groups without properties explored, no limit ended
  /// another search, and no effect exceeds --fail-on.
  [[nodiscard]] bool is_answered() const;
};

/// The word for a result: "proved".
[[nodiscard]] std::string_view name_of(Verdict::Result result);

/// The name of a property, or if it has none, what it says.
[[nodiscard]] std::string title_of(const CompiledCatalog& catalog, const Property& property);

/// Why no state counts for a property that is proved: "'when' holds in no reachable state".
[[nodiscard]] std::string describe_vacuity(const Property& property);

/// What ended an exploration that is not complete, how far it came, and how to go on.
[[nodiscard]] std::string describe_limit(const VerifyResult& result,
                                         const Exploration& exploration);

/// What was found out about a property of a part, with how far that reaches: "violated after 4
/// events", "proved for 61 reachable states", "undecided: ended by --max-states 1000; …".
[[nodiscard]] std::string describe_answer(const VerifyResult& result, const VerifyPart& part,
                                          const PropertyAnswer& answer);

/// "LIGHT is night and GPS is unavailable"
[[nodiscard]] std::string describe_part(const CompiledCatalog& catalog, const SituationPart& part);

/// Adds the outcomes of an exploration: what runs, how the situation differs from the one that the
/// assumptions state, and what leads there.
void add_outcomes(const CompiledCatalog& catalog, const Assumptions& assumptions,
                  const std::vector<ReportedOutcome>& outcomes, Text& text);
void add_how_to_read_outcomes(Text& text);

/// Adds the behaviors without which a task cannot run.
void add_single_faults(const VerifyResult& result, Text& text);

/// Adds the effects of faults, or the cut sets, task by task.
void add_effects(const VerifyResult& result, Text& text);
/// All effects, as CSV (RFC 4180), and as a page.
[[nodiscard]] std::string effects_to_csv(const VerifyResult& result, const Style& style);
[[nodiscard]] std::string effects_to_html(const VerifyResult& result);

/// Adds the matrix of who gives way to whom; the same as a page.
void add_overrides(const VerifyResult& result, Text& text);

/// The result for people.
[[nodiscard]] std::string verify_to_text(const VerifyResult& result, const Style& style);

[[nodiscard]] std::string verify_to_json(const VerifyResult& result);
[[nodiscard]] std::string verify_schema();

/// A page of all properties, with a timeline of each counterexample and witness.
[[nodiscard]] std::string verify_to_html(const VerifyResult& result);

/// A format of `cbc verify`.
struct VerifyFormat : ReportFormat<VerifyResult> {
  bool needs_tests = false;    ///< properties or a comparison; it has no place for anything else
  bool needs_effects = false;  ///< the same for effects of faults
};

/// The first one is the default.
[[nodiscard]] std::span<const VerifyFormat> verify_formats();

}  // namespace cbc
