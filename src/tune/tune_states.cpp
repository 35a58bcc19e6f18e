// Tolerances over all decisions of all reachable states.

#include <string>

#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "core/files/progress.h"
#include "core/files/question_loader.h"
#include "core/property/properties.h"
#include "runtime/base/text.h"
#include "tune/engine/state_tuner.h"
#include "tune/tune_steps.h"

namespace cbc::cli {
namespace {

/// That there are states that were not looked at.
int complain_of_end(const std::string& file, Budget::End end, const TuneOptions& options) {
  complain("{}: expected all reachable states to be visited; an exploration was {}", quote(file),
           options.limits.budget().describe(end));
  return exit_no;
}

StateTuner explore_present(const CheckedCatalog& source, const std::vector<TunableNumber>& numbers,
                           const PropertyFile& file, const TuneOptions& options) {
  Progress progress("exploring", 1);
  ExplorationOptions of_exploration;
  of_exploration.budget = options.limits.budget().started();
  of_exploration.budget.tell = progress.listener();
  of_exploration.jobs = thread_count(options.jobs);
  return {source.reading.catalog, numbers, file, of_exploration};
}

}  // namespace

int tune_states(const TuneOptions& options) {
  if (options.paths.empty()) return usage_error("tune", "expected a catalog or a property file");
  QuestionLoader loader;
  const std::optional<CheckedInput> input = loader.load(options.paths, {});
  if (!input) return report_unreadable("cbc tune", options.format, "-", loader.findings());
  if (input->files.size() > 1) {
    return usage_error("tune", "--all-states takes at most one property file, found {}",
                       input->files.size());
  }
  const CheckedCatalog& source = *input->catalog;
  if (!has_numbers(source)) return exit_unusable;
  const auto numbers = choose_numbers(source.reading, options.only);
  if (!numbers || (options.html && !can_write_output(*options.html))) return exit_unusable;
  PropertyFile file;
  if (input->files.empty()) {
    file.assumptions = default_assumptions(*source.compiled);
  } else {
    file = *input->files.front();
  }
  const StateTuner tuner = explore_present(source, *numbers, file, options);
  const StateSurvey& survey = tuner.present();
  const std::string& name = source.reading.catalog.file;
  if (survey.error) return complain("{}: {}", quote(name), *survey.error);
  if (survey.end) return complain_of_end(name, *survey.end, options);
  const Recording none_run;
  TuneResult result = begin_result(source, *numbers, none_run, options);
  result.states.emplace(
      TunedStates{survey.states, survey.transitions, survey.decisions.size(), file});
  const auto found = for_each_number("tuning", result, options,
                                     [&](std::size_t number) { return tuner.tolerance(number); });
  for (std::size_t number = 0; number < found.size(); ++number) {
    if (found[number].end) return complain_of_end(name, *found[number].end, options);
    result.tuned.push_back({found[number].tolerance, {}, tuner.is_used(number)});
  }
  if (const int status = write_reports(result, options); status != exit_ok) return status;
  return status_of(result);
}

}  // namespace cbc::cli
