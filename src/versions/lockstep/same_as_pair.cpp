#include "versions/lockstep/same_as_pair.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace cbc {

namespace {

/// The variables that behaviors of these groups name, as another catalog counts, if it has them.
std::set<std::uint32_t> variables_in_other(const CompiledCatalog& catalog,
                                           const std::vector<GroupId>& groups,
                                           const Translation& to_other) {
  std::set<std::uint32_t> variables;
  for (const GroupId group : groups) {
    for (const std::uint32_t variable : variables_named_by(catalog, group)) {
      const std::uint32_t known = to_other.variables[variable];
      if (known != none) variables.insert(known);
    }
  }
  return variables;
}

}  // namespace

ModelPair::ModelPair(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                     const GroupPair& groups, const Assumptions& old_assumptions,
                     const Assumptions& new_assumptions, const TranslationPair& of_names)
    : translations(of_names),
      old_model(old_catalog, groups.old_groups, old_assumptions,
                variables_in_other(new_catalog, groups.new_groups, of_names.to_old)),
      new_model(new_catalog, groups.new_groups, new_assumptions,
                variables_in_other(old_catalog, groups.old_groups, of_names.to_new)) {
  add_tasks();
  add_behaviors();
  add_moves();
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
  const auto value_of = [&](std::uint32_t place, std::uint32_t value) {
    const std::uint32_t variable = model.variables()[place].id;
    return std::pair<std::uint32_t, std::int64_t>(
        id_of(variable, &Translation::variables),
        to_other == nullptr ? value : to_other->values[variable][value]);
  };
  switch (kind) {
    case Move::Kind::due:
      return {kind, {}};
    case Move::Kind::start:
    case Move::Kind::stop:
      return {kind,
              {{id_of(model.tasks()[choice.subject].id, &Translation::tasks), choice.move.choice}}};
    case Move::Kind::variable:
      return {kind, {value_of(choice.subject, choice.choice)}};
    case Move::Kind::together: {
      Key key{kind, {}};
      for (const auto& [variable, value] : model.joint_changes()[choice.subject].values) {
        key.second.push_back(value_of(variable, value));
      }
      std::sort(key.second.begin(), key.second.end());
      return key;
    }
    case Move::Kind::own:
      return {kind, {{id_of(model.own_flags()[choice.subject].id, &Translation::behaviors), 0}}};
    default:
      return {kind, {{id_of(model.behaviors()[choice.subject].id, &Translation::behaviors), 0}}};
  }
}

/// Adds the moves of the new model together with those of the old one. Both have the variables that
/// both catalogs have and that behaviors of either one name, and what `never` ties to them.
void ModelPair::add_moves() {
  std::map<Key, const Model::Choice*> of_old;
  for (const Model::Choice& choice : old_model.moves()) {
    of_old[key_of(old_model, choice, nullptr)] = &choice;
  }
  for (const Model::Choice& choice : new_model.moves()) {
    const Key key = key_of(new_model, choice, &translations.to_old);
    const auto found = of_old.find(key);
    if (found != of_old.end()) {
      moves.push_back({&choice, found->second, choice.move});
    } else if (choice.move.kind == Move::Kind::due ||
               (choice.move.kind == Move::Kind::repair && key.second.front().first != none)) {
      moves.push_back({&choice, nullptr, choice.move});
    }
    of_old.erase(key);
  }
  for (const Model::Choice& choice : old_model.moves()) {
    if (choice.move.kind != Move::Kind::repair) continue;
    if (!of_old.contains(key_of(old_model, choice, nullptr))) continue;
    const BehaviorId id = translations.to_new.behaviors[old_model.behaviors()[choice.subject].id];
    if (id == none || new_model.find_behavior(id) == none) continue;
    Move move = choice.move;
    move.subject = new_model.catalog().behaviors[id].catalog_index;
    const auto place = std::find_if(moves.begin(), moves.end(), [&](const PairedMove& other) {
      return other.move.kind > Move::Kind::repair ||
             (other.move.kind == Move::Kind::repair && other.move.subject > move.subject);
    });
    moves.insert(place, {nullptr, &choice, move});
  }
  if (new_model.reactive().empty() && !old_model.reactive().empty()) {
    moves.push_back({nullptr, &old_model.moves().back(), old_model.moves().back().move});
  }
}

}  // namespace cbc
