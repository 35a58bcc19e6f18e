#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/property/properties.h"
#include "explore/model/model.h"
#include "runtime/compiled/compiled_catalog.h"
#include "versions/names/translation.h"

namespace cbc {

/// The models of both catalogs, and what is the same in them. Catalogs and translations must
/// outlive it.
struct ModelPair {
  ModelPair(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
            const GroupPair& groups, const Assumptions& old_assumptions,
            const Assumptions& new_assumptions, const TranslationPair& of_names);

  /// A task of the new model and the same of the old one; none: one of them does not have it.
  using TaskPair = std::pair<std::uint32_t, std::uint32_t>;
  [[nodiscard]] static bool is_in_both(const TaskPair& task) {
    return task.first != none && task.second != none;
  }
  [[nodiscard]] bool is_same_task(std::uint32_t of_new, std::uint32_t of_old) const {
    return pair_of_new[of_new] == pair_of_old[of_old];
  }
  [[nodiscard]] bool is_same_behavior(std::uint32_t of_new, std::uint32_t of_old) const {
    return new_model.behaviors()[of_new].id ==
           translations.to_new.behaviors[old_model.behaviors()[of_old].id];
  }
  /// Whether both have the behavior, and a task that it performs here.
  [[nodiscard]] bool is_compared(std::uint32_t behavior, bool is_new) const {
    return (is_new ? new_is_compared : old_is_compared)[behavior];
  }
  /// The numbers that both have among the reactive tasks; none: it is not one of them.
  [[nodiscard]] TaskPair reactive_of(const TaskPair& task) const {
    return {task.first == none ? none : new_model.tasks()[task.first].reactive,
            task.second == none ? none : old_model.tasks()[task.second].reactive};
  }

  const TranslationPair& translations;
  Model old_model;
  Model new_model;
  /// The same move in both; only one of them may have a queue, or remember a failure.
  struct PairedMove {
    const Model::Choice* of_new = nullptr;  ///< null: the new one does not have it
    const Model::Choice* of_old = nullptr;  ///< null: the old one does not have it
    Move move;                              ///< as the new catalog counts
  };
  std::vector<PairedMove> moves;
  /// In the order of the new catalog, then those that only the old one has, in its order.
  std::vector<TaskPair> tasks;
  // By task of a model: its place in `tasks`.
  std::vector<std::uint32_t> pair_of_new;
  std::vector<std::uint32_t> pair_of_old;
  // By behavior of a model: see is_compared.
  std::vector<bool> new_is_compared;
  std::vector<bool> old_is_compared;

 private:
  /// A move, with the ids of its task, behavior or variables, each with its priority or value.
  using Key = std::pair<Move::Kind, std::vector<std::pair<std::uint32_t, std::int64_t>>>;

  [[nodiscard]] static Key key_of(const Model& model, const Model::Choice& choice,
                                  const Translation* to_other);
  void add_tasks();
  void add_behaviors();
  void add_moves();
};

}  // namespace cbc
