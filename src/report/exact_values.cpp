#include "report/exact_values.h"

#include <cstdlib>

#include <boost/multiprecision/cpp_int.hpp>

namespace cbc {
namespace {

using boost::multiprecision::cpp_int;

/// A product of suitabilities.
struct Product {
  cpp_int digits = 1;
  int decimals = 0;

  void multiply(Millionths suitability) {
    if (suitability == 0) {
      digits = 0;
      return;
    }
    decimals += 6;
    for (; suitability % 10 == 0; suitability /= 10) --decimals;
    if (suitability != 1) digits *= suitability;
  }

  [[nodiscard]] double nearest_double() const {
    if (digits == 0) return 0;
    if (decimals == 0) return 1;
    return std::strtod((digits.str() + "e-" + std::to_string(decimals)).c_str(), nullptr);
  }

  /// It is 1 at most.
  [[nodiscard]] std::string exact() const {
    if (digits == 0) return "0";
    if (decimals == 0) return "1";
    std::string text = digits.str();
    text.insert(0, static_cast<std::size_t>(decimals) - text.size(), '0');
    text.erase(text.find_last_not_of('0') + 1);
    return "0." + text;
  }
};

void multiply_elsewhere(const CompiledCatalog& catalog, const State& state, std::uint32_t group,
                        Product& product) {
  for (const std::uint32_t index : state.running()) {
    const TaskId task = catalog.task_ids[index];
    if (catalog.tasks[task].group == group) continue;
    product.multiply(catalog.values[task][state.place(task)].suitability);
  }
}

void multiply_group(const CompiledCatalog& catalog, std::uint32_t group, const Assignment& places,
                    Product& product) {
  const TaskId first = catalog.group_tasks[group];
  for (std::uint32_t task = 0; task < places.size(); ++task) {
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

double total_suitability(const CompiledCatalog& catalog, const State& state, std::uint32_t group,
                         const Assignment& places) {
  Product product;
  multiply_elsewhere(catalog, state, group, product);
  multiply_group(catalog, group, places, product);
  return product.nearest_double();
}

std::string exact_suitability(const CompiledCatalog& catalog, const State& state,
                              std::uint32_t group, const Assignment& places) {
  Product product;
  multiply_elsewhere(catalog, state, group, product);
  if (product.digits == 0) product = {};
  multiply_group(catalog, group, places, product);
  return product.exact();
}

double idle_share(const ObjectiveValues& objective) {
  if (objective.idle_total == 0) return 1;
  return static_cast<double>(objective.idle_total - objective.idle_running) /
         static_cast<double>(objective.idle_total);
}

double to_seconds(Microseconds time) {
  return static_cast<double>(time) / static_cast<double>(second);
}

}  // namespace cbc
