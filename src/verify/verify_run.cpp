#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "ask/together.h"
#include "core/command_line/command_line.h"
#include "core/files/ordered_work.h"
#include "core/files/output.h"
#include "core/files/progress.h"
#include "core/files/question_loader.h"
#include "core/files/signals.h"
#include "core/property/properties.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_catalog.h"
#include "verify/found_scripts.h"
#include "verify/named_in_options.h"
#include "verify/report/verify_report.h"
#include "verify/verify.h"

namespace cbc::cli {

namespace {

/// Makes the folder of --scripts, and looks whether the other outputs can be written. All has been
/// read. Returns the exit status, and prints what is wrong.
int prepare_outputs(const VerifyOptions& options) {
  std::vector<std::string> outputs;
  if (options.output != "-") outputs.push_back(options.output);
  if (options.html) outputs.push_back(*options.html);
  for (const std::string& output : outputs) {
    if (!can_write_output(output)) return exit_unusable;
  }
  return options.scripts ? make_folder(*options.scripts) : exit_ok;
}

/// One call of the command, after its input was read.
class Call {
 public:
  Call(const VerifyOptions& options, CheckedInput input)
      : options_(options), input_(std::move(input)), catalog_(*input_.catalog->compiled) {
    result_.catalog = input_.catalog->compiled;
    result_.text = input_.catalog->text;
    result_.limits = options.limits.budget();
    result_.limits.is_stopped = [this] { return signals_.have_come(); };
  }

  int run() {
    if (const int status = check(); status != exit_ok) return status;
    explore();
    if (const std::string error = first_error(); !error.empty()) return complain(error);
    find_single_faults();
    if (options_.effects || wants_cut_sets()) find_effects();
    if (options_.overrides) {
      if (const int status = find_overrides(); status != exit_ok) return status;
    }
    if (const int status = replay_answers(options_, result_); status != exit_ok) return status;
    if (options_.outcomes) {
      if (const int status = replay_outcomes(options_, result_); status != exit_ok) return status;
    }
    if (options_.html) {
      const int status = write_output(*options_.html, page());
      if (status != exit_ok) return status;
    }
    if (const int status = compare(); status != exit_ok) return status;
    return report();
  }

 private:
  /// The tasks of --refused as promises that they can start, under the assumptions of the property
  /// file, if there is one.
  int add_refused() {
    if (options_.refused.empty()) return exit_ok;
    if (input_.files.size() > 1) {
      return usage_error("verify", "--refused takes at most one property file, found {}",
                         input_.files.size());
    }
    const auto tasks = find_tasks(catalog_, "--refused", options_.refused);
    if (!tasks) return exit_unusable;
    PropertyFile file;
    if (input_.files.empty()) {
      file.assumptions = default_assumptions(catalog_);
    } else {
      file = *input_.files.front();
      input_.files.clear();
    }
    if (file.path.empty()) file.path = "refused";
    for (const TaskId task : *tasks) {
      Property& property = file.properties.emplace_back();
      property.name = fmt::format("a start of {} is never refused", catalog_.name_of_task(task));
      property.line = file.properties.size();  // there is none
      property.task = task;
    }
    input_.files.push_back(std::make_unique<const PropertyFile>(std::move(file)));
    return exit_ok;
  }

  /// Only what property files assume counts.
  void leave_out_properties() {
    for (auto& file : input_.files) {
      PropertyFile without = *file;
      without.properties.clear();
      file = std::make_unique<const PropertyFile>(std::move(without));
    }
  }

  /// Whatever can be wrong is said before the long work.
  int check() {
    if (const int status = add_refused(); status != exit_ok) return status;
    if (options_.outcomes) leave_out_properties();
    const VerifyFormat& format = *find_named(verify_formats(), options_.format);
    const bool has_properties =
        std::all_of(input_.files.begin(), input_.files.end(),
                    [](const auto& file) { return !file->properties.empty(); }) &&
        !input_.files.empty();
    const char* const needs_properties = format.needs_tests && !options_.same_as   ? "--format"
                                         : options_.scripts && !finds_scripts()    ? "--scripts"
                                         : options_.html && !asks_only_otherwise() ? "--html"
                                                                                   : nullptr;
    if (needs_properties != nullptr && !has_properties) {
      return usage_error("verify", "{}{}{} needs property files with properties", needs_properties,
                         format.needs_tests ? " " : "", format.needs_tests ? options_.format : "");
    }
    if (format.needs_effects && !options_.effects) {
      return usage_error("verify", "--format {} needs --effects", options_.format);
    }
    const char* const takes_one_file = wants_cut_sets()     ? "--cut-sets"
                                       : options_.effects   ? "--effects"
                                       : options_.overrides ? "--overrides"
                                       : options_.outcomes  ? "--outcomes"
                                       : options_.same_as   ? "--same-as"
                                                            : nullptr;
    if (takes_one_file != nullptr && input_.files.size() > 1) {
      return usage_error("verify", "{} takes at most one property file, found {}", takes_one_file,
                         input_.files.size());
    }
    const auto tasks = find_tasks(catalog_, "--cut-sets", options_.cut_sets);
    if (!tasks) return exit_unusable;
    cut_tasks_ = *tasks;
    if (const int status = read_situation(); status != exit_ok) return status;
    if (const int status = read_renames(); status != exit_ok) return status;
    return prepare_outputs(options_);
  }

  /// The situation of the command line, or else of the property file, and what never occurs.
  int read_situation() {
    for (const std::string& entry : options_.situation) {
      const std::string fault = add_to_situation(catalog_, entry, result_.situation);
      if (!fault.empty()) return complain("--situation: " + fault);
    }
    if (input_.files.size() != 1) return exit_ok;
    const PropertyFile& file = *input_.files.front();
    if (options_.situation.empty()) result_.situation = file.assumptions.initially;
    result_.never = file.assumptions.never;
    if (asks_only_otherwise()) return check_situation(file);
    if (!options_.situation.empty() && !situations().find(situations().all())) {
      return complain(
          "--situation: expected a situation that may occur, but 'never' of {} "
          "excludes every one with these values",
          quote(file.path));
    }
    return exit_ok;
  }

  /// The situation from which effects are has to be one that occurs.
  int check_situation(const PropertyFile& file) {
    const SituationPart complete = complete_situation(catalog_, result_.situation);
    const SituationSpace space(catalog_, complete, result_.never);
    if (space.find(space.all())) return exit_ok;
    return complain("'never' of {} excludes the situation; expected one that may occur, found {}",
                    quote(file.path),
                    join(complete.variables, ", ", [&](const VariableValue& value) {
                      return describe_value(catalog_, value);
                    }));
  }

  [[nodiscard]] SituationSpace situations() const {
    return {catalog_, result_.situation, result_.never};
  }

  [[nodiscard]] bool wants_cut_sets() const { return !options_.cut_sets.empty(); }

  /// Whether property files only say what is assumed.
  [[nodiscard]] bool asks_only_otherwise() const { return options_.effects || options_.overrides; }

  /// Whether there are scripts without properties.
  [[nodiscard]] bool finds_scripts() const { return options_.same_as || options_.outcomes; }

  /// The tasks that the assumptions let be requested, in catalog order.
  [[nodiscard]] std::vector<TaskId> requestable_tasks() const {
    const Assumptions assumptions =
        input_.files.empty() ? default_assumptions(catalog_) : input_.files.front()->assumptions;
    std::vector<TaskId> tasks;
    for (const Assumptions::Start& start : assumptions.start) tasks.push_back(start.task);
    return tasks;
  }

  int read_renames() {
    if (options_.renamed.empty()) return exit_ok;
    const std::string fault =
        add_renames(*input_.old_catalog, catalog_, options_.renamed, comparison_.renames);
    return fault.empty() ? exit_ok : usage_error("verify", "--renamed: {}", fault);
  }

  [[nodiscard]] std::size_t count_explorations() const {
    if (input_.files.empty()) return catalog_.group_count();
    std::size_t count = 0;
    for (const auto& file : input_.files) {
      std::set<PropertyScope> explored;
      for (const Property& property : file->properties) {
        explored.insert(scope_of(catalog_, property));
      }
      count += file->properties.empty() ? catalog_.group_count() : explored.size();
    }
    return count;
  }

  void explore() {
    if (asks_only_otherwise()) return;
    const bool asks_otherwise = wants_cut_sets() || options_.same_as;
    if (input_.files.empty() && asks_otherwise) return;
    Progress progress("exploring", count_explorations());
    ExplorationOptions of_verification;
    of_verification.budget = result_.limits;
    of_verification.budget.tell = progress.listener();
    of_verification.jobs = thread_count(options_.jobs);
    of_verification.reduce = true;
    of_verification.outcomes = options_.outcomes;
    if (input_.files.empty()) {
      result_.parts.push_back({nullptr, verify_groups(catalog_, of_verification), {}});
    }
    for (auto& file : input_.files) {
      Verification verification = verify_properties(catalog_, *file, of_verification);
      result_.parts.push_back({std::move(file), std::move(verification), {}});
    }
  }

  /// Compares with the older catalog, under the assumptions of the property file if there is one.
  int compare() {
    if (input_.old_catalog == nullptr) return exit_ok;
    const CompiledCatalog& old_catalog = *input_.old_catalog;
    Progress progress("comparing", catalog_.group_count());
    ExplorationOptions of_comparison;
    of_comparison.budget = result_.limits;
    of_comparison.budget.tell = progress.listener();
    of_comparison.jobs = thread_count(options_.jobs);
    comparison_.is_by_default = result_.parts.empty();
    comparison_.allow_missing = options_.allow_missing;
    ReportedComparison& reported = result_.same_as.emplace();
    reported.old_catalog = input_.old_catalog;
    reported.assumptions = result_.parts.empty()
                               ? common_assumptions(old_catalog, catalog_, comparison_.renames)
                               : result_.parts.front().file->assumptions;
    reported.comparison =
        compare_catalogs(old_catalog, catalog_, reported.assumptions, of_comparison, comparison_);
    progress.clear();
    if (reported.comparison.error) return complain(*reported.comparison.error);
    return replay_differences(options_, result_);
  }

  /// About a question that has no answer; empty if there is none.
  [[nodiscard]] std::string first_error() const {
    for (const VerifyPart& part : result_.parts) {
      for (const Exploration& exploration : part.verification.explorations) {
        if (exploration.error) {
          const std::string_view file = part.file ? part.file->path : catalog_.file;
          return fmt::format("{}: {}", quote(file), *exploration.error);
        }
      }
    }
    return {};
  }

  /// Of what can be requested, where it is shown what can happen at all.
  void find_single_faults() {
    const bool is_about_groups =
        std::any_of(result_.parts.begin(), result_.parts.end(),
                    [](const VerifyPart& part) { return part.is_about_groups(); });
    if (!is_about_groups || options_.format != "text" || options_.outcomes) return;
    const SituationSpace in = situations();
    Progress progress("searching", catalog_.task_ids.size());
    const EffectOptions of_search{1, false, search_budget(progress)};
    for (const TaskId task : catalog_.task_ids) {
      if (catalog_.tasks[task].start_on_request == 0) continue;
      result_.single_faults.push_back(find_cut_sets(in, task, of_search));
    }
  }

  /// All effects, or only the cut sets of some tasks.
  void find_effects() {
    ReportedEffects& effects = result_.effects.emplace();
    effects.are_cut_sets = wants_cut_sets();
    effects.in_some_situation = options_.in_some_situation;
    effects.order = options_.order.value_or(effects.are_cut_sets ? 2 : 1);
    effects.situation =
        effects.are_cut_sets ? result_.situation : complete_situation(catalog_, result_.situation);
    if (options_.situations) {
      effects.changes = changes_of(catalog_, effects.situation, result_.never);
    }
    if (options_.fail_on) effects.limit = limit_of(*options_.fail_on);
    const SituationSpace in = situations();
    const std::vector<TaskId> tasks = effects.are_cut_sets ? cut_tasks_ : requestable_tasks();
    Progress progress("searching", tasks.size());
    const EffectOptions of_search{effects.order, effects.in_some_situation,
                                  search_budget(progress)};
    for (const TaskId task : tasks) {
      effects.tasks.push_back(
          effects.are_cut_sets
              ? find_cut_sets(in, task, of_search)
              : cbc::find_effects(catalog_, task, effects.situation, effects.changes, of_search));
    }
  }

  /// For several searches together.
  [[nodiscard]] Budget search_budget(Progress& progress) const {
    Budget budget = result_.limits.started();
    budget.tell = progress.listener();
    return budget;
  }

  int find_overrides() {
    ReportedOverrides& overrides = result_.overrides.emplace();
    overrides.situation = complete_situation(catalog_, result_.situation);
    const std::vector<TaskId> tasks = requestable_tasks();
    if (tasks.size() > most_tasks_in_pairs) {
      return complain(
          "--overrides: {} can be requested; expected at most {} (a property file can "
          "list fewer: assume: {{start: [TASK...]}})",
          quantity(tasks.size(), "task"), most_tasks_in_pairs);
    }
    Progress progress("searching", 1);
    overrides.matrix =
        cbc::find_overrides(catalog_, tasks, overrides.situation, search_budget(progress));
    progress.clear();
    if (overrides.matrix.error.empty()) return exit_ok;
    complain("{}", overrides.matrix.error);
    complain("this is a bug in cbc, not in the catalog; please report it with the catalog");
    return exit_internal;
  }

  static EffectLimit limit_of(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos) return {text, 0};
    return {text, static_cast<std::uint32_t>(tenths_in(text.substr(colon + 1)))};
  }

  [[nodiscard]] std::string page() const {
    return options_.effects ? effects_to_html(result_) : verify_to_html(result_);
  }

  int report() {
    const int status = write_report(verify_formats(), options_.format, result_, options_.output);
    if (status != exit_ok) return status;
    return result_.is_answered() ? exit_ok : exit_no;
  }

  const VerifyOptions& options_;
  CheckedInput input_;
  const CompiledCatalog& catalog_;
  StopSignals signals_;
  VerifyResult result_;
  std::vector<TaskId> cut_tasks_;
  ComparisonScope comparison_;
};

}  // namespace

int verify(const VerifyOptions& options) {
  QuestionLoader loader;
  std::optional<CheckedInput> input = loader.load(options.paths, options.same_as);
  if (!input) {
    return report_unreadable("cbc verify", options.format, options.output, loader.findings());
  }
  return Call(options, std::move(*input)).run();
}

}  // namespace cbc::cli
