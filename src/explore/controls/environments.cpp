// The environment of a state, apart from its control: featured transition systems (A. Classen, M.
// Cordy, P.-Y. Schobbens, P. Heymans, A. Legay and J.-F. Raskin, "Featured transition systems",
// IEEE Transactions on Software Engineering 39 (2013)) explore a family of systems so. There the
// features never change; here the situation does, and behaviors become faulty, so moves map sets of
// environments to sets.

#include "explore/controls/environments.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace cbc {

namespace {

/// The bits of a variable that has a code.
Diagrams::Values values_of(const EnvironmentBits::Variable& variable, std::uint32_t code) {
  Diagrams::Values values;
  for (std::uint32_t place = 0; place < variable.width; ++place) {
    const std::uint32_t shift = variable.width - 1U - place;
    values.bits.emplace_back(variable.first + place, ((code >> shift) & 1U) != 0);
  }
  return values;
}

}  // namespace

EnvironmentBits bits_of(const Model& model, bool has_mark) {
  EnvironmentBits bits;
  for (const Model::Variable& variable : model.variables()) {
    EnvironmentBits::Variable& added = bits.variables.emplace_back();
    if (variable.cell == none) continue;
    added.first = bits.count;
    added.width = static_cast<std::uint32_t>(std::bit_width(variable.values - 1));
    added.codes.resize(variable.values);
    std::iota(added.codes.begin(), added.codes.end(), 0U);
    added.code_at_first = variable.initial;
    bits.count += added.width;
  }
  while (bits.own.size() < model.layout().own_count) bits.own.push_back(bits.count++);
  while (bits.failed.size() < model.layout().failed_count) bits.failed.push_back(bits.count++);
  if (has_mark) bits.mark = bits.count++;
  while (bits.fault.size() < model.layout().faulty_count) bits.fault.push_back(bits.count++);
  return bits;
}

Environments::Environments(const Model& model, EnvironmentBits bits, Diagrams& sets)
    : model_(model), bits_(std::move(bits)), sets_(sets), tables_(1) {
  find_conditions();
  find_never();
  find_room_in_x();
  for (const std::uint32_t bit : bits_.fault) {
    faulty_.push_back(bit == none ? Diagrams::empty : sets_.with(bit, true));
  }
}

void Environments::write_first(std::vector<std::uint8_t>& string) const {
  const auto write = [&](const Diagrams::Values& values) {
    for (const auto& [bit, value] : values.bits) string[bit] = value ? 1 : 0;
  };
  for (const EnvironmentBits::Variable& variable : bits_.variables) {
    write(values_of(variable, variable.code_at_first));
  }
  const std::vector<std::uint16_t> cells = model_.first_state();
  for (std::uint32_t own = 0; own < bits_.own.size(); ++own) {
    if (bits_.own[own] != none) write({{{bits_.own[own], cells[model_.layout().own + own] != 0}}});
  }
}

// Conditions.

Environments::Set Environments::with_code(std::uint32_t variable, std::uint32_t code) {
  return sets_.with(values_of(bits_.variables[variable], code));
}

Environments::Set Environments::with_value(std::uint32_t variable, std::uint32_t value) {
  const EnvironmentBits::Variable& bits = bits_.variables[variable];
  const bool is_initial = model_.variables()[variable].initial == value;
  if (bits.first == none) return is_initial ? Diagrams::all : Diagrams::empty;
  const std::uint32_t code = bits.codes[value];
  const Set usual = code == none ? Diagrams::empty : with_code(variable, code);
  if (!is_initial || code == bits.code_at_first) return usual;
  return sets_.either(usual, with_code(variable, bits.code_at_first));
}

Environments::Set Environments::with_own_flag(std::uint32_t own) {
  return bits_.own[own] == none ? Diagrams::empty : sets_.with(bits_.own[own], true);
}

Environments::Set Environments::denied(std::uint32_t behavior) {
  const std::uint32_t own = model_.behaviors()[behavior].own;
  if (own != none && bits_.own[own] != none) return with_own_flag(own);
  return has_bit(model_.denied().data(), behavior) ? Diagrams::all : Diagrams::empty;
}

Environments::Set Environments::faulty(std::uint32_t behavior) const {
  const std::uint32_t fault = model_.behaviors()[behavior].fault;
  return fault == none ? Diagrams::empty : faulty_[fault];
}

Environments::Set Environments::failed(std::uint32_t behavior) {
  const std::uint32_t failed = model_.behaviors()[behavior].failed;
  const bool may_be = failed != none && bits_.failed[failed] != none;
  return may_be ? sets_.with(bits_.failed[failed], true) : Diagrams::empty;
}

void Environments::find_conditions() {
  fitting_.assign(model_.behaviors().size(), Diagrams::all);
  for (std::uint32_t variable = 0; variable < model_.variables().size(); ++variable) {
    const auto& misfits = model_.variables()[variable].misfits;
    for (std::uint32_t value = 0; value < misfits.size(); ++value) {
      const Set here = with_value(variable, value);
      for_each_bit(misfits[value].data(), misfits[value].size(), [&](std::uint32_t behavior) {
        fitting_[behavior] = sets_.without(fitting_[behavior], here);
      });
    }
  }
  for (std::uint32_t behavior = 0; behavior < fitting_.size(); ++behavior) {
    permitted_.push_back(sets_.without(fitting_[behavior], denied(behavior)));
    available_.push_back(sets_.without(permitted_[behavior], failed(behavior)));
  }
}

void Environments::find_never() {
  const Model::Layout& layout = model_.layout();
  const auto set_of = [&](std::uint32_t cell, std::uint16_t value) {
    if (cell >= layout.own) {
      const std::uint32_t own = cell - layout.own;
      if (bits_.own[own] != none) return sets_.with(bits_.own[own], value != 0);
      return model_.first_state()[cell] == value ? Diagrams::all : Diagrams::empty;
    }
    const auto& variables = model_.variables();
    const auto variable = std::find_if(variables.begin(), variables.end(),
                                       [&](const auto& one) { return one.cell == cell; });
    return with_value(static_cast<std::uint32_t>(variable - variables.begin()), value);
  };
  for (const Model::Excluded& excluded : model_.excluded()) {
    Set all_parts = Diagrams::all;
    for (const auto& [cell, value] : excluded) {
      all_parts = sets_.both(all_parts, set_of(cell, value));
    }
    never_ = sets_.either(never_, all_parts);
  }
}

/// From the last bit to the first, which keeps each step small.
void Environments::find_room_in_x() {
  const auto most = model_.assumptions().most_failed;
  if (!most) return;
  std::vector<Set> exactly(*most, Diagrams::empty);
  if (!exactly.empty()) exactly[0] = Diagrams::all;
  for (std::size_t place = bits_.failed.size(); place-- > 0;) {
    if (bits_.failed[place] == none) continue;
    const Set in_x = sets_.with(bits_.failed[place], true);
    for (std::size_t count = exactly.size(); count-- > 0;) {
      const Set one_more = count > 0 ? sets_.both(exactly[count - 1], in_x) : Diagrams::empty;
      exactly[count] = sets_.either(sets_.without(exactly[count], in_x), one_more);
    }
  }
  room_in_x_ = Diagrams::empty;
  for (const Set set : exactly) room_in_x_ = sets_.either(room_in_x_, set);
}

// Moves.

std::vector<Environments::ActionEffect> Environments::effects_of(const Model::Choice& choice) {
  const std::uint32_t subject = choice.subject;
  switch (choice.move.kind) {
    case Move::Kind::variable: {
      const EnvironmentBits::Variable& bits = bits_.variables[subject];
      return {change(choice.move, sets_.complement(with_value(subject, choice.choice)),
                     values_of(bits, bits.codes[choice.choice]))};
    }
    case Move::Kind::own: {
      const std::uint32_t bit = bits_.own[subject];
      std::vector<ActionEffect> effects;
      for (const bool is_denied : {false, true}) {
        Move move = choice.move;
        move.choice = is_denied ? 0 : 1;
        effects.push_back(change(move, sets_.with(bit, !is_denied), {{{bit, is_denied}}}));
      }
      return effects;
    }
    case Move::Kind::together:
      return {joint_change(choice.move, model_.joint_changes()[subject])};
    case Move::Kind::repair: {
      const Model::Behavior& behavior = model_.behaviors()[subject];
      Diagrams::Values values;
      if (behavior.failed != none) values.bits.emplace_back(bits_.failed[behavior.failed], false);
      if (behavior.fault != none) values.bits.emplace_back(bits_.fault[behavior.fault], false);
      std::erase_if(values.bits, [](const auto& bit) { return bit.first == none; });
      return {
          change(choice.move, sets_.either(faulty(subject), failed(subject)), std::move(values))};
    }
    default: {
      ActionEffect effect;
      effect.move = choice.move;
      if (choice.move.kind == Move::Kind::situation_change) effect.condition = denied(subject);
      const bool may_join_x =
          choice.move.kind == Move::Kind::failure && model_.behaviors()[subject].failed != none;
      if (may_join_x) effect.condition = room_in_x_;
      return {effect};
    }
  }
}

Environments::ActionEffect Environments::change(const Move& move, Set condition,
                                                Diagrams::Values values) {
  ActionEffect effect;
  effect.move = move;
  effect.condition = condition;
  effect.changes = true;
  effect.values = sets_.keep(std::move(values));
  effect.excluded = sets_.before_change(never_, effect.values);
  effect.table = static_cast<std::uint32_t>(tables_.size());
  tables_.emplace_back();
  return effect;
}

/// It exists where at least two of the variables have other values.
Environments::ActionEffect Environments::joint_change(const Move& move,
                                                      const Model::JointChange& change_of) {
  Set none_differs = Diagrams::all;
  Set one_differs = Diagrams::empty;
  Diagrams::Values all_values;
  for (const auto& [variable, value] : change_of.values) {
    const Set has_value = with_value(variable, value);
    one_differs =
        sets_.either(sets_.both(one_differs, has_value), sets_.without(none_differs, has_value));
    none_differs = sets_.both(none_differs, has_value);
    const EnvironmentBits::Variable& bits = bits_.variables[variable];
    const Diagrams::Values values = values_of(bits, bits.codes[value]);
    all_values.bits.insert(all_values.bits.end(), values.bits.begin(), values.bits.end());
  }
  std::sort(all_values.bits.begin(), all_values.bits.end());
  return change(move, sets_.complement(sets_.either(none_differs, one_differs)),
                std::move(all_values));
}

Environments::Set Environments::after_to_before(const ActionEffect& effect, Set set) {
  return effect.changes ? sets_.before_change(set, effect.values) : set;
}

Environments::Table& Environments::table_of(const ActionEffect& effect) {
  Table& table = tables_[effect.table];
  if (std::exchange(table.is_known, true)) return table;
  const std::size_t behaviors = model_.behaviors().size();
  table.gains.assign(model_.groups().size(), Diagrams::empty);
  table.possible.clear(model_);
  for (std::uint32_t behavior = 0; behavior < behaviors; ++behavior) {
    if (after_to_before(effect, fitting_[behavior]) == Diagrams::empty) continue;
    const Set is_available = after_to_before(effect, available_[behavior]);
    table.possible.add(model_, behavior, is_available != Diagrams::empty);
    Set& gains = table.gains[model_.behaviors()[behavior].group];
    gains = sets_.either(gains, sets_.without(is_available, available_[behavior]));
  }
  return table;
}

Environments::Set Environments::query(const ActionEffect& effect, EnvironmentQuery query) {
  using Kind = EnvironmentQuery::Kind;
  const std::uint32_t subject = query.subject;
  switch (query.kind) {
    case Kind::fits:
      return after_to_before(effect, fitting_[subject]);
    case Kind::available:
      return after_to_before(effect, available_[subject]);
    case Kind::permitted:
      return after_to_before(effect, permitted_[subject]);
    case Kind::faulty:
      return after_to_before(effect, faulty(subject));
    case Kind::is_broken:
      return sets_.either(faulty(subject), failed(subject));
    case Kind::gains:
      return table_of(effect).gains[subject];
  }
  return Diagrams::empty;
}

const Stepper::Possible& Environments::possible_after(const ActionEffect& effect) {
  return table_of(effect).possible;
}

}  // namespace cbc
