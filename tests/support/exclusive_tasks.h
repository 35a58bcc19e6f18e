#pragma once

#include <cstddef>
#include <string>

namespace cbc::test {

/// A catalog of tasks T0, T1, …, each with one behavior B0, B1, …, in one exclusivity list.
inline std::string exclusive_tasks(std::size_t count) {
  std::string behaviors = "behaviors:\n";
  std::string list;
  for (std::size_t task = 0; task < count; ++task) {
    const std::string number = std::to_string(task);
    behaviors += "- {behavior: B" + number + ", task: T" + number + "}\n";
    list += (task == 0 ? "T" : ", T") + number;
  }
  return behaviors + "exclusivity_constraints: [mutually_exclusive: [" + list + "]]\n";
}

}  // namespace cbc::test
