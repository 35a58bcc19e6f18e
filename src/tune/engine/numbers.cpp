#include "tune/engine/numbers.h"

#include <algorithm>
#include <map>
#include <utility>

#include "runtime/base/text.h"

namespace cbc {

std::vector<TunableNumber> find_numbers(const CatalogReading& reading) {
  using Kind = TunableNumber::Kind;
  std::map<std::pair<Position, Kind>, TunableNumber> by_place;
  for (const NumberPlace& place : reading.numbers) {
    by_place[{place.range.begin, place.kind}] = {
        place.kind, place.is_default, place.value, place.range, {}};
  }
  TunableNumber unwritten;
  unwritten.is_default = true;
  unwritten.value = one_million;
  const Catalog& catalog = reading.catalog;
  const auto minimum_at = [&](const Range& range) {
    const auto found = by_place.find({range.begin, Kind::minimum_performance});
    return found == by_place.end() || range == Range{} ? nullptr : &found->second;
  };
  for (std::uint32_t behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    const Behavior& of = catalog.behaviors[behavior];
    for (std::uint32_t entry = 0; entry < of.performs.size(); ++entry) {
      const auto& range = of.performs[entry].suitability_range;
      TunableNumber& number = range ? by_place.at({range->begin, Kind::suitability}) : unwritten;
      number.uses.push_back({behavior, entry, of.performs[entry].task});
    }
    for (std::uint32_t entry = 0; entry < of.requirements.size(); ++entry) {
      const Requirement& requirement = of.requirements[entry];
      TunableNumber* const number = minimum_at(requirement.minimum_performance_range);
      if (number != nullptr) number->uses.push_back({behavior, entry, requirement.task});
    }
  }
  for (TaskIndex task = 0; task < catalog.tasks.size(); ++task) {
    TunableNumber* const number = minimum_at(catalog.tasks[task].minimum_performance_range);
    if (number != nullptr) number->uses.push_back({none, 0, task});
  }
  std::vector<TunableNumber> numbers;
  numbers.reserve(by_place.size() + 1);
  for (auto& [place, number] : by_place) numbers.push_back(std::move(number));
  if (!unwritten.uses.empty()) numbers.push_back(std::move(unwritten));
  return numbers;
}

namespace {

/// What all uses of a number share; none if they do not.
template <typename Part>
std::uint32_t shared_by(const TunableNumber& number, Part TunableNumber::Use::*part) {
  if (number.is_default || number.uses.empty()) return none;
  const std::uint32_t first = number.uses.front().*part;
  const bool is_shared = std::all_of(number.uses.begin(), number.uses.end(),
                                     [&](const auto& use) { return use.*part == first; });
  return is_shared ? first : none;
}

}  // namespace

std::uint32_t behavior_of(const TunableNumber& number) {
  return shared_by(number, &TunableNumber::Use::behavior);
}

std::uint32_t task_of(const TunableNumber& number) {
  return shared_by(number, &TunableNumber::Use::task);
}

std::string describe(const TunableNumber& number, const Catalog& catalog) {
  const bool is_suitability = number.kind == TunableNumber::Kind::suitability;
  if (number.is_default) return "default suitability";
  std::string text = is_suitability ? "suitability" : "minimum";
  const std::uint32_t behavior = behavior_of(number);
  const std::uint32_t task = task_of(number);
  const std::string of_behavior = behavior != none ? catalog.behaviors[behavior].name : "";
  const std::string of_task = task != none ? catalog.tasks[task].name : "";
  const std::string& subject = is_suitability ? of_behavior : of_task;
  const std::string& object = is_suitability ? of_task : of_behavior;
  if (!subject.empty()) text += " of " + printable(subject);
  if (!object.empty()) text += " for " + printable(object);
  return text;
}

void set_number(Catalog& catalog, const TunableNumber& number, Millionths value) {
  for (const TunableNumber::Use& use : number.uses) {
    if (number.kind == TunableNumber::Kind::suitability) {
      catalog.behaviors[use.behavior].performs[use.entry].suitability = value;
    } else if (use.behavior != none) {
      catalog.behaviors[use.behavior].requirements[use.entry].minimum_performance = value;
    } else {
      catalog.tasks[use.task].minimum_performance = value;
    }
  }
}

}  // namespace cbc
