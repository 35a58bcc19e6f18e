#include "verify/engine/same_as_pair.h"

#include <algorithm>
#include <map>

namespace cbc {

ModelPair::ModelPair(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                     const GroupPair& groups, const Assumptions& old_assumptions,
                     const Assumptions& new_assumptions, const TranslationPair& of_names)
    : translations(of_names),
      old_model(old_catalog, groups.old_groups, old_assumptions),
      new_model(new_catalog, groups.new_groups, new_assumptions) {
  add_tasks();
  add_behaviors();
  add_moves();
  add_variables_of_old();
}

void ModelPair::add_tasks() {
  pair_of_new.resize(new_model.tasks().size());
  pair_of_old.resize(old_model.tasks().size());
  for (const std::uint32_t task : new_model.tasks_in_order()) {
    const TaskId known = translations.to_old.tasks[new_model.tasks()[task].id];
    const std::uint32_t of_old = known != none ? old_model.find_task(known) : none;
    pair_of_new[task] = static_cast<std::uint32_t>(tasks.size());
    if (of_old != none) pair_of_old[of_old] = pair_of_new[task];
    tasks.emplace_back(task, of_old);
  }
  for (const std::uint32_t task : old_model.tasks_in_order()) {
    if (translations.to_new.tasks[old_model.tasks()[task].id] != none) continue;
    pair_of_old[task] = static_cast<std::uint32_t>(tasks.size());
    tasks.emplace_back(none, task);
  }
}

void ModelPair::add_behaviors() {
  const auto add = [&](const Model& model, const Translation& to_other,
                       const std::vector<std::uint32_t>& pairs, std::vector<bool>& are_compared) {
    for (const Model::Behavior& behavior : model.behaviors()) {
      const bool has_task = std::any_of(
          behavior.values.begin(), behavior.values.end(),
          [&](std::uint32_t value) { return is_in_both(tasks[pairs[model.task_of(value)]]); });
      are_compared.push_back(has_task && to_other.behaviors[behavior.id] != none);
    }
  };
  add(new_model, translations.to_old, pair_of_new, new_is_compared);
  add(old_model, translations.to_new, pair_of_old, old_is_compared);
}

/// As the catalog of the model counts, or as the other one does.
ModelPair::Key ModelPair::key_of(const Model& model, const Model::Choice& choice,
                                 const Translation* to_other) {
  const Move::Kind kind = choice.move.kind;
  const auto id_of = [&](auto id, auto ids) {
    return to_other == nullptr ? id : (to_other->*ids)[id];
  };
  switch (kind) {
    case Move::Kind::due:
      return {kind, 0, 0};
    case Move::Kind::start:
    case Move::Kind::stop:
      return {kind, id_of(model.tasks()[choice.subject].id, &Translation::tasks),
              choice.move.choice};
    case Move::Kind::variable: {
      const std::uint32_t variable = model.variables()[choice.subject].id;
      return {kind, id_of(variable, &Translation::variables),
              to_other == nullptr ? choice.choice : to_other->values[variable][choice.choice]};
    }
    default:
      return {kind, id_of(model.behaviors()[choice.subject].id, &Translation::behaviors), 0};
  }
}

/// Adds the moves of the new model together with those of the old one.
void ModelPair::add_moves() {
  std::map<Key, const Model::Choice*> of_old;
  for (const Model::Choice& choice : old_model.moves()) {
    of_old[key_of(old_model, choice, nullptr)] = &choice;
  }
  for (const Model::Choice& choice : new_model.moves()) {
    const Key key = key_of(new_model, choice, &translations.to_old);
    const auto found = of_old.find(key);
    const bool has_both = found != of_old.end();
    // The old catalog may have a variable and its value, although no behavior of its groups names
    // it.
    const bool is_known = choice.move.kind == Move::Kind::variable && std::get<1>(key) != none &&
                          std::get<2>(key) != none;
    if (has_both || is_known || choice.move.kind == Move::Kind::due) {
      moves.push_back({&choice, has_both ? found->second : nullptr, choice.move});
    }
  }
  if (new_model.reactive().empty() && !old_model.reactive().empty()) {
    moves.push_back({nullptr, &old_model.moves().back(), old_model.moves().back().move});
  }
}

/// Adds the changes of variables that both catalogs have and only behaviors of the old groups name.
void ModelPair::add_variables_of_old() {
  for (const Model::Choice& choice : old_model.moves()) {
    if (choice.move.kind != Move::Kind::variable) continue;
    const auto [kind, variable, value] = key_of(old_model, choice, &translations.to_new);
    if (variable == none || value == none || new_model.find_variable(variable) != none) continue;
    moves.push_back({nullptr, &choice, {kind, variable, static_cast<std::int32_t>(value)}});
  }
  // Those of the new groups are in order, and so are moves of one kind that is no change.
  std::stable_sort(moves.begin(), moves.end(), [](const PairedMove& a, const PairedMove& b) {
    if (a.move.kind != b.move.kind) return a.move.kind < b.move.kind;
    return a.move.kind == Move::Kind::variable &&
           std::tie(a.move.subject, a.move.choice) < std::tie(b.move.subject, b.move.choice);
  });
}

}  // namespace cbc
