#include "report/exact_values.h"

#include <cstdlib>

#include <boost/multiprecision/cpp_int.hpp>

namespace cbc {
namespace {

using boost::multiprecision::cpp_int;

}  // namespace

double total_suitability(const CompiledCatalog& catalog, const State& state) {
  cpp_int digits = 1;
  int decimals = 0;
  for (const std::uint32_t index : state.running()) {
    const TaskId task = catalog.task_ids[index];
    Millionths suitability = catalog.values[task][state.place(task)].suitability;
    if (suitability == 0) return 0;
    decimals += 6;
    for (; suitability % 10 == 0; suitability /= 10) --decimals;
    if (suitability != 1) digits *= suitability;
  }
  if (decimals == 0) return 1;
  return std::strtod((digits.str() + "e-" + std::to_string(decimals)).c_str(), nullptr);
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
