#include "core/words/suitability.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include <fmt/format.h>

#include "runtime/base/natural.h"
#include "runtime/base/text.h"

namespace cbc {

namespace {

/// A product of suitabilities.
class Product {
 public:
  void multiply(Millionths suitability) {
    if (suitability == 0) {
      is_zero_ = true;
      return;
    }
    decimals_ += 6;
    for (; suitability % 10 == 0; suitability /= 10) --decimals_;
    if (suitability != 1) numerator_.multiply(suitability);
  }

  [[nodiscard]] bool is_zero() const { return is_zero_; }

  [[nodiscard]] double nearest_double() const {
    if (is_zero_) return 0;
    if (decimals_ == 0) return 1;
    return std::strtod((numerator_.digits() + "e-" + std::to_string(decimals_)).c_str(), nullptr);
  }

  /// The product is at most 1.
  [[nodiscard]] std::string exact() const {
    if (is_zero_) return "0";
    if (decimals_ == 0) return "1";
    std::string text = numerator_.digits();
    text.insert(0, decimals_ - text.size(), '0');
    text.erase(text.find_last_not_of('0') + 1);
    return "0." + text;
  }

 private:
  bool is_zero_ = false;
  Natural numerator_;
  std::size_t decimals_ = 0;  ///< the denominator is 10 to this power
};

void multiply_elsewhere(const CompiledCatalog& catalog, const State& state, GroupId group,
                        Product& product) {
  for (const std::uint32_t index : state.running()) {
    const TaskId task = catalog.task_ids[index];
    if (catalog.tasks[task].group == group) continue;
    product.multiply(catalog.values[task][state.value_index(task)].suitability);
  }
}

void multiply_group(const CompiledCatalog& catalog, GroupId group, const Assignment& places,
                    Product& product) {
  const TaskId first = catalog.group_tasks[group];
  for (LocalTask task(0); task < places.size(); ++task) {
    if (places[task] == none) continue;
    product.multiply(catalog.values[first + task][places[task]].suitability);
  }
}

}  // namespace

double total_suitability(const CompiledCatalog& catalog, const State& state) {
  Product product;
  multiply_elsewhere(catalog, state, none, product);
  return product.nearest_double();
}

double total_suitability(const CompiledCatalog& catalog, const State& state, GroupId group,
                         const Assignment& places) {
  Product product;
  multiply_elsewhere(catalog, state, group, product);
  multiply_group(catalog, group, places, product);
  return product.nearest_double();
}

std::string exact_suitability(const CompiledCatalog& catalog, const State& state, GroupId group,
                              const Assignment& places) {
  Product product;
  multiply_elsewhere(catalog, state, group, product);
  if (product.is_zero()) product = {};
  multiply_group(catalog, group, places, product);
  return product.exact();
}

namespace {

Product multiply(std::span<const Millionths> suitabilities) {
  Product product;
  for (const Millionths suitability : suitabilities) product.multiply(suitability);
  return product;
}

}  // namespace

double product_of(std::span<const Millionths> suitabilities) {
  return multiply(suitabilities).nearest_double();
}

std::string exact_product(std::span<const Millionths> suitabilities) {
  return multiply(suitabilities).exact();
}

std::string percent_of_product(std::span<const Millionths> suitabilities) {
  const std::string digits = multiply(suitabilities).exact();
  if (digits == "1") return "100";
  std::string millionths = digits.size() > 2 ? digits.substr(2, 6) : "";
  millionths.resize(6, '0');
  return format_decimal(std::stol(millionths), 4);
}

namespace {

/// Digits shown after the common beginning of two long numbers.
constexpr std::size_t digits_beyond = 6;

std::string cut_digits(const std::string& number, std::size_t length) {
  return number.size() <= length + 1 ? number : number.substr(0, length) + "...";
}

}  // namespace

std::string shorten_number(const std::string& number) {
  const std::size_t first = std::min(number.find_first_not_of("0."), number.size());
  return cut_digits(number, std::max<std::size_t>(first, 2) + digits_beyond);
}

std::pair<std::string, std::string> shorten_both(const std::string& a, const std::string& b) {
  const auto differs = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const auto equal = static_cast<std::size_t>(differs.first - a.begin());
  const std::size_t length = std::max<std::size_t>(equal, 2) + digits_beyond;
  return {cut_digits(a, length), cut_digits(b, length)};
}

double idle_share(const ObjectiveValues& objective) {
  if (objective.idle_total == 0) return 1;
  return static_cast<double>(objective.idle_total - objective.idle_running) /
         static_cast<double>(objective.idle_total);
}

AnswerBound bound_of_answer(const CompiledCatalog& catalog, const EventRecord& record,
                            const State& state) {
  const GroupId group = record.search->group;
  const SearchBound& bound = record.search->result.bound;
  const Assignment nothing(catalog.group_tasks[group + 1] - catalog.group_tasks[group], none);
  const double elsewhere = total_suitability(catalog, state, group, nothing);
  // Up by more than the rounding of both factors and of the product.
  constexpr double above_rounding = 1 + 1e-15;
  const double product = std::min(1.0, elsewhere * bound.suitability * above_rounding);
  return {record.objective->satisfied + bound.more_requests,
          std::max(product, total_suitability(catalog, state))};
}

std::string describe_bound(const CompiledCatalog& catalog, const EventRecord& record,
                           const State& state) {
  const SearchBound& bound = record.search->result.bound;
  if (bound.more_requests > 0) {
    return fmt::format("the best may serve {} more {}", bound.more_requests,
                       bound.more_requests == 1 ? "request" : "requests");
  }
  if (!bound.same_requests) return "the best may serve other requests";
  const double suitability = total_suitability(catalog, state);
  if (suitability == 0) return {};
  const double best = bound_of_answer(catalog, record, state).suitability;
  if (best <= suitability) return "no suitability is higher";
  // Less than a percent is one, as percentages are rounded up.
  return fmt::format("within {} % of the best", std::ceil(100 * (best - suitability) / best));
}

}  // namespace cbc
