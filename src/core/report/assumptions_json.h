#pragma once

#include "core/compile/catalog_json.h"
#include "core/property/properties.h"
#include "core/support/json_description.h"

namespace cbc::json {

inline constexpr auto entries_of_part = [](const SituationPart& part, const auto& context) {
  return [&](const auto& put) {
    const CompiledCatalog& catalog = catalog_in(context);
    for (const VariableValue value : part.variables) {
      put(catalog.name_of_variable(value.variable), value);
    }
    for (const SituationPart::Own& own : part.behaviors) {
      put(catalog.name_of_behavior(own.behavior), own.available);
    }
  };
};

/// What describe_assumptions says, with names; the context has the catalog.
inline constexpr auto assumptions = object(
    "assumptions",
    "Which events may happen, and what is true at first; members have the names of the keys in a "
    "property file.",
    member("file", nullable(any_text), "The property file; null for the default assumptions.",
           [](const StatedAssumptions& of) { return of.file.empty() ? nullptr : &of.file; }),
    member(
        "start", map(task, list(integer(1)).unique()),
        "The tasks that may be requested, each with the priorities.",
        [](const StatedAssumptions& of) -> const auto& { return of.assumptions.start; }),
    member(
        "stop", tasks, "The tasks that may be stopped.",
        [](const StatedAssumptions& of) -> const auto& { return of.assumptions.stop; }),
    member("successes", boolean, "Whether behaviors succeed.",
           [](const StatedAssumptions& of) { return of.assumptions.successes; }),
    member("failures", boolean, "Whether behaviors fail.",
           [](const StatedAssumptions& of) { return of.assumptions.failures; }),
    member("faults", count, "How many behaviors may be faulty at a time.",
           [](const StatedAssumptions& of) { return of.assumptions.faults; }),
    member(
        "situation", names,
        "The situation variables that may change, and the behaviors that may become unavailable.",
        [](const StatedAssumptions& of, const auto& context) {
          return [&](const auto& put) {
            const CompiledCatalog& catalog = catalog_in(context);
            for (const std::uint32_t place : of.assumptions.variables) {
              put(catalog.name_of_variable(place));
            }
            for (const BehaviorId id : of.assumptions.behaviors) {
              put(catalog.name_of_behavior(id));
            }
          };
        }),
    member(
        "never", list(projected(entries_of_part, situation)), "Situations that do not occur.",
        [](const StatedAssumptions& of) -> const auto& { return of.assumptions.never; }),
    member(
        "initially", projected(entries_of_part, situation),
        "What differs at first from initial values, and from available behaviors.",
        [](const StatedAssumptions& of) -> const auto& { return of.assumptions.initially; }));

}  // namespace cbc::json
