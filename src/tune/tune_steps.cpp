#include "tune/tune_steps.h"

#include <algorithm>
#include <string_view>

#include "core/files/output.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {

Millionths degree_of(const std::string& percentage) {
  constexpr Millionths tenth_of_a_percent = 1000;
  return static_cast<Millionths>(tenths_in(percentage)) * tenth_of_a_percent;
}

bool has_numbers(const CheckedCatalog& source) {
  if (source.text != nullptr) return true;
  complain("the catalog {} was compiled; expected the YAML, which has the numbers",
           quote(source.compiled->file));
  return false;
}

std::optional<std::vector<TunableNumber>> choose_numbers(const CatalogReading& reading,
                                                         const std::vector<std::string>& only) {
  std::vector<TunableNumber> numbers = find_numbers(reading);
  if (only.empty()) return numbers;
  const Catalog& catalog = reading.catalog;
  std::vector<std::string> known;
  std::vector<std::string_view> names;
  std::vector<TunableNumber> chosen;
  for (TunableNumber& number : numbers) {
    bool is_chosen = false;
    for (const TunableNumber::Use& use : number.uses) {
      if (use.behavior == none) continue;
      known.push_back(catalog.behaviors[use.behavior].name + ":" + catalog.tasks[use.task].name);
      is_chosen |= std::find(only.begin(), only.end(), known.back()) != only.end();
    }
    if (is_chosen) chosen.push_back(std::move(number));
  }
  names.reserve(known.size());
  for (const std::string& name : known) names.push_back(name);
  for (const std::string& name : only) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    complain("--only: catalog {} has no number of {}{}", quote(catalog.file), quote(name),
             did_you_mean(nearest(name, names)));
    return std::nullopt;
  }
  return chosen;
}

TuneResult begin_result(const CheckedCatalog& source, const std::vector<TunableNumber>& numbers,
                        const Recording& present, const TuneOptions& options) {
  TuneResult result{source.reading.catalog, *source.compiled, numbers, present, {}, {}, {}, {}};
  if (!options.fail_under.empty()) result.fail_under = degree_of(options.fail_under);
  return result;
}

int write_reports(const TuneResult& result, const TuneOptions& options) {
  const int status = write_report(tune_formats(), options.format, result, "-");
  if (status != exit_ok || !options.html) return status;
  return write_output(*options.html, tune_to_html(result));
}

int status_of(const TuneResult& result) {
  std::size_t fragile = 0;
  for (std::size_t number = 0; number < result.numbers.size(); ++number) {
    if (result.is_fragile(number)) ++fragile;
  }
  if (fragile > 0) {
    complain("{} may be wrong by less than {} (--fail-under)", quantity(fragile, "number"),
             format_decimal(*result.fail_under, 4));
  }
  return fragile > 0 || !result.present.failures.empty() ? exit_no : exit_ok;
}

}  // namespace cbc::cli
