#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"

/// What the tests of the modules behind the readers share: catalogs from text, and names instead of
/// numbers. A name that is not there fails the test.
namespace cbc::test {

/// Reads and compiles a catalog without errors.
[[nodiscard]] CompiledCatalog compile_text(std::string_view yaml);

/// A catalog in which each of the tasks T0, T1, … runs alone, hardly suitable, or requires the next
/// one: a bound of T0's cost has a cut for each task, which holds all those before it.
[[nodiscard]] std::string chain_of_alternatives(int length);

[[nodiscard]] TaskId task_id(const CompiledCatalog& catalog, std::string_view name);
[[nodiscard]] BehaviorId behavior_id(const CompiledCatalog& catalog, std::string_view name);
/// Index of a task within its group.
[[nodiscard]] LocalTask local_task(const CompiledCatalog& catalog, std::string_view name);
/// Index of a behavior among the values of a task.
[[nodiscard]] std::uint32_t value_index(const CompiledCatalog& catalog, std::string_view task,
                                        std::string_view behavior);

/// A problem in which every task of the group may have every value, and nothing runs before.
[[nodiscard]] Problem open_problem(const CompiledCatalog& catalog, GroupId group = GroupId());
/// The task has to run.
void demand(Problem& problem, const CompiledCatalog& catalog, std::string_view task);
/// A request, less important than those added before.
void request(Problem& problem, const CompiledCatalog& catalog, std::string_view task);
/// The task runs with the behavior before the event.
void set_present(Problem& problem, const CompiledCatalog& catalog, std::string_view task,
                 std::string_view behavior);
/// Leaves a value out of the domain.
void leave_out(Problem& problem, const CompiledCatalog& catalog, std::string_view task,
               std::string_view behavior);
/// Leaves all behaviors out of the domain.
void leave_out_all(Problem& problem, const CompiledCatalog& catalog, std::string_view task);

/// The running tasks of an answer: "A=a B=b".
[[nodiscard]] std::string show(const CompiledCatalog& catalog, const Assignment& answer,
                               GroupId group = GroupId());
/// The answer of which this is the text.
[[nodiscard]] Assignment answer_of(const CompiledCatalog& catalog, std::string_view text,
                                   GroupId group = GroupId());

}  // namespace cbc::test
