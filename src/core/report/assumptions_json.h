#pragma once

#include <cstdint>
#include <vector>

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

inline constexpr auto what_may_change = [](const Assumptions& of, const auto& context) {
  return [&](const auto& put) {
    const CompiledCatalog& catalog = catalog_in(context);
    for (const std::uint32_t place : of.variables) put(catalog.name_of_variable(place));
    for (const BehaviorId id : of.behaviors) put(catalog.name_of_behavior(id));
  };
};

inline constexpr auto names_of_variables = [](const std::vector<std::uint32_t>& places,
                                              const auto& context) {
  return [&](const auto& put) {
    const CompiledCatalog& catalog = catalog_in(context);
    for (const std::uint32_t place : places) put(catalog.name_of_variable(place));
  };
};

/// What describe_assumptions says, with names; the context has the catalog.
inline constexpr auto assumptions = object(
    "assumptions",
    "Which events may happen, and what is true at first; members have the names of the keys in a "
    "property file.",
    member("file", nullable(any_text), "The property file; null for the default assumptions.",
           [](const StatedAssumptions& of) { return of.file.empty() ? nullptr : &of.file; }),
    part(&StatedAssumptions::assumptions,
         group(member("start", map(task, list(integer(1)).unique()),
                      "The tasks that may be requested, each with the priorities.",
                      &Assumptions::start),
               member("stop", tasks, "The tasks that may be stopped.", &Assumptions::stop),
               member("successes", boolean, "Whether behaviors succeed.", &Assumptions::successes),
               member("failures", boolean, "Whether behaviors fail.", &Assumptions::failures),
               optional("most_failed", count,
                        "At most so many of them are remembered at a time; absent: any number.",
                        &Assumptions::most_failed),
               optional("most_suspended", count,
                        "How many requests are suspended at a time, at most; absent: any number.",
                        &Assumptions::most_suspended),
               member("faults", count, "How many behaviors may be faulty at a time.",
                      &Assumptions::faults),
               optional("faults_of", behaviors, "The only behaviors that can become faulty.",
                        [](const Assumptions& of) {
                          return of.only_listed_fail ? &of.listed_for_faults : nullptr;
                        }),
               optional("faults_except", behaviors, "Behaviors that cannot become faulty.",
                        [](const Assumptions& of) {
                          return of.only_listed_fail || of.listed_for_faults.empty()
                                     ? nullptr
                                     : &of.listed_for_faults;
                        }),
               member("situation", names,
                      "The situation variables that may change, and the behaviors that may become "
                      "unavailable.",
                      what_may_change),
               member("never", list(projected(entries_of_part, situation)),
                      "Situations that do not occur.", &Assumptions::never),
               optional(
                   "frozen", projected(names_of_variables, names),
                   "Of the variables that may change: `never` keeps these as they are.",
                   [](const Assumptions& of) { return of.frozen.empty() ? nullptr : &of.frozen; }),
               optional("together", list(projected(names_of_variables, names.at_least(2))),
                        "Variables that may change at once.",
                        [](const Assumptions& of) {
                          return of.together.empty() ? nullptr : &of.together;
                        }),
               member("initially", projected(entries_of_part, situation),
                      "What differs at first from initial values, and from available behaviors.",
                      &Assumptions::initially))));

}  // namespace cbc::json
