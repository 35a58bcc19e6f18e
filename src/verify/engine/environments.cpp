// The environment of a state, apart from its control: featured transition systems (A. Classen, M.
// Cordy, P.-Y. Schobbens, P. Heymans, A. Legay and J.-F. Raskin, "Featured transition systems",
// IEEE Transactions on Software Engineering 39 (2013)) explore a family of systems so. There the
// features never change; here the situation does, and behaviors become faulty, so moves map sets of
// environments to sets.

#include "verify/engine/environments.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace cbc {

namespace {

/// The bits of a variable; 0: it does not change.
std::uint32_t width_of(const Model::Variable& variable) {
  if (variable.cell == none) return 0;
  return static_cast<std::uint32_t>(std::bit_width(variable.values - 1));
}

std::uint32_t bits_of(const Model& model) {
  std::uint32_t bits = model.layout().own_count + model.layout().faulty_count;
  for (const Model::Variable& variable : model.variables()) bits += width_of(variable);
  return bits;
}

/// The faults, of which there are few at a time, are the last bits.
std::uint32_t tail_of(const Model& model) {
  return Diagrams::tail_for(model.layout().faulty_count, model.assumptions().faults);
}

}  // namespace

Environments::Environments(const Model& model, bool has_mark)
    : model_(model),
      sets_(bits_of(model) + (has_mark ? 1 : 0), tail_of(model), model.assumptions().faults) {
  for (const Model::Variable& variable : model_.variables()) {
    first_bit_.push_back(variable.cell != none ? first_own_ : none);
    first_own_ += width_of(variable);
  }
  mark_bit_ = first_own_ + model_.layout().own_count;
  first_fault_ = mark_bit_ + (has_mark ? 1 : 0);
  if (has_mark) {
    marked_ = sets_.with(mark_bit_, true);
    mark_set_ = sets_.keep({{{mark_bit_, true}}});
    mark_cleared_ = sets_.keep({{{mark_bit_, false}}});
  }
  find_conditions();
  find_never();
  count_faults_in_all();
  add_effects();
}

Diagrams::Values Environments::values_of(std::uint32_t variable, std::uint32_t value) const {
  Diagrams::Values values;
  const std::uint32_t width = width_of(model_.variables()[variable]);
  for (std::uint32_t place = 0; place < width; ++place) {
    const std::uint32_t shift = width - 1U - place;
    values.bits.emplace_back(first_bit_[variable] + place, ((value >> shift) & 1U) != 0);
  }
  return values;
}

Environments::Set Environments::with_value(std::uint32_t variable, std::uint32_t value) {
  if (first_bit_[variable] == none) {
    return model_.variables()[variable].initial == value ? Diagrams::all : Diagrams::empty;
  }
  return sets_.with(values_of(variable, value));
}

Environments::Set Environments::denied(std::uint32_t behavior) {
  const std::uint32_t own = model_.behaviors()[behavior].own;
  if (own != none) return sets_.with(first_own_ + own, true);
  return has_bit(model_.denied().data(), behavior) ? Diagrams::all : Diagrams::empty;
}

Environments::Set Environments::faulty(std::uint32_t behavior) const {
  const std::uint32_t fault = model_.behaviors()[behavior].fault;
  return fault == none ? Diagrams::empty : faulty_[fault];
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
    available_.push_back(sets_.without(fitting_[behavior], denied(behavior)));
  }
}

void Environments::find_never() {
  const Model::Layout& layout = model_.layout();
  for (const Model::Excluded& excluded : model_.excluded()) {
    Set all_parts = Diagrams::all;
    for (const auto& [cell, value] : excluded) {
      const auto variable =
          std::find_if(model_.variables().begin(), model_.variables().end(),
                       [cell = cell](const auto& one) { return one.cell == cell; });
      const Set part =
          variable != model_.variables().end()
              ? with_value(static_cast<std::uint32_t>(variable - model_.variables().begin()), value)
              : sets_.with(first_own_ + (cell - layout.own), value != 0);
      all_parts = sets_.both(all_parts, part);
    }
    never_ = sets_.either(never_, all_parts);
  }
}

void Environments::count_faults_in_all() {
  const std::uint32_t faults = model_.layout().faulty_count;
  for (std::uint32_t fault = 0; fault < faults; ++fault) {
    faulty_.push_back(sets_.with(first_fault_ + fault, true));
  }
  const std::uint32_t most = std::min(model_.assumptions().faults, faults);
  exactly_.assign(most + 1, Diagrams::empty);
  exactly_[0] = Diagrams::all;
  for (std::uint32_t fault = faults; fault-- > 0;) {
    const Set faulty = faulty_[fault];
    for (std::uint32_t count = most + 1; count-- > 0;) {
      const Set one_more = count > 0 ? sets_.both(exactly_[count - 1], faulty) : Diagrams::empty;
      exactly_[count] = sets_.either(sets_.without(exactly_[count], faulty), one_more);
    }
  }
  for (std::uint32_t count = 0; count < most; ++count) room_ = sets_.either(room_, exactly_[count]);
  std::vector<bool> all_bits(sets_.bits(), false);
  std::vector<std::vector<bool>> bits(model_.groups().size(), all_bits);
  for (const Model::Behavior& behavior : model_.behaviors()) {
    if (behavior.fault == none) continue;
    all_bits[first_fault_ + behavior.fault] = true;
    bits[behavior.group][first_fault_ + behavior.fault] = true;
  }
  for (std::vector<bool>& of_group : bits) {
    faults_of_group_.push_back(sets_.keep_bits(std::move(of_group)));
  }
  all_faults_ = sets_.keep_bits(std::move(all_bits));
}

void Environments::add_effects() {
  tables_.emplace_back();
  const auto& moves = model_.moves();
  for (std::uint32_t choice = 0; choice < moves.size(); ++choice) {
    const Model::Choice& move = moves[choice];
    switch (move.move.kind) {
      case Move::Kind::fault:
      case Move::Kind::repair:
        break;
      case Move::Kind::variable:
        add_effect(choice, sets_.complement(with_value(move.subject, move.choice)),
                   values_of(move.subject, move.choice));
        break;
      case Move::Kind::own: {
        const std::uint32_t bit = first_own_ + move.subject;
        for (const bool is_denied : {false, true}) {
          add_effect(choice, sets_.with(bit, !is_denied), {{{bit, is_denied}}});
        }
        break;
      }
      case Move::Kind::together:
        add_joint_effect(choice, model_.joint_changes()[move.subject]);
        break;
      default: {
        Effect effect;
        effect.choice = choice;
        if (move.move.kind == Move::Kind::situation_change) effect.condition = denied(move.subject);
        effects_.push_back(effect);
        break;
      }
    }
  }
}

void Environments::add_effect(std::uint32_t choice, Set condition, const Diagrams::Values& values) {
  Effect effect;
  effect.choice = choice;
  effect.changes = true;
  effect.values = sets_.keep(values);
  effect.condition = sets_.without(condition, sets_.before_change(never_, effect.values));
  if (effect.condition == Diagrams::empty) return;
  effect.table = static_cast<std::uint32_t>(tables_.size());
  tables_.emplace_back();
  effects_.push_back(effect);
}

/// It exists where at least two of the variables have other values.
void Environments::add_joint_effect(std::uint32_t choice, const Model::JointChange& change) {
  Set none_differs = Diagrams::all;
  Set one_differs = Diagrams::empty;
  Diagrams::Values all_values;
  for (const auto& [variable, value] : change.values) {
    const Set has_value = with_value(variable, value);
    one_differs =
        sets_.either(sets_.both(one_differs, has_value), sets_.without(none_differs, has_value));
    none_differs = sets_.both(none_differs, has_value);
    const Diagrams::Values values = values_of(variable, value);
    all_values.bits.insert(all_values.bits.end(), values.bits.begin(), values.bits.end());
  }
  add_effect(choice, sets_.complement(sets_.either(none_differs, one_differs)), all_values);
}

Environments::Set Environments::after_to_before(const Effect& effect, Set set) {
  return effect.changes ? sets_.before_change(set, effect.values) : set;
}

Environments::Table& Environments::table_of(const Effect& effect) {
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

Environments::Set Environments::query(const Effect& effect, EnvironmentQuery query) {
  using Kind = EnvironmentQuery::Kind;
  const std::uint32_t subject = query.subject;
  switch (query.kind) {
    case Kind::fits:
      return after_to_before(effect, fitting_[subject]);
    case Kind::available:
      return after_to_before(effect, available_[subject]);
    case Kind::faulty:
      return faulty(subject);
    case Kind::gains:
      return table_of(effect).gains[subject];
  }
  return Diagrams::empty;
}

const Stepper::Possible& Environments::possible_after(const Effect& effect) {
  return table_of(effect).possible;
}

// The mark.

Environments::Set Environments::with_mark(Set set, Set to_set, Set to_clear) {
  const Set kept = sets_.without(sets_.without(set, to_set), to_clear);
  const Set newly = sets_.changed(sets_.both(set, to_set), mark_set_);
  const Set cleared = sets_.changed(sets_.both(set, to_clear), mark_cleared_);
  return sets_.either(kept, sets_.either(newly, cleared));
}

Environments::Set Environments::before_mark(Set set, Set to_set, Set to_clear) {
  const Set kept = sets_.without(sets_.without(set, to_set), to_clear);
  const Set newly = sets_.both(sets_.before_change(set, mark_set_), to_set);
  const Set cleared = sets_.both(sets_.before_change(set, mark_cleared_), to_clear);
  return sets_.either(kept, sets_.either(newly, cleared));
}

// Environments of states.

void Environments::read(const std::uint16_t* cells, std::vector<std::uint8_t>& string) const {
  const Model::Layout& layout = model_.layout();
  string.assign(sets_.bits(), 0);
  for (std::uint32_t variable = 0; variable < first_bit_.size(); ++variable) {
    if (first_bit_[variable] == none) continue;
    for (const auto& [bit, value] :
         values_of(variable, cells[model_.variables()[variable].cell]).bits) {
      string[bit] = value ? 1 : 0;
    }
  }
  for (std::uint32_t own = 0; own < layout.own_count; ++own) {
    string[first_own_ + own] = cells[layout.own + own] != 0 ? 1 : 0;
  }
  for (std::uint32_t fault = 0; fault < layout.faulty_count; ++fault) {
    string[first_fault_ + fault] = cells[layout.faulty + fault] != 0 ? 1 : 0;
  }
}

Environments::Set Environments::environment_of(const std::uint16_t* cells) {
  std::vector<std::uint8_t> string;
  read(cells, string);
  Diagrams::Values values;
  for (std::uint32_t bit = 0; bit < string.size(); ++bit) {
    values.bits.emplace_back(bit, string[bit] != 0);
  }
  return sets_.with(values);
}

// Moves.

Environments::Set Environments::after(const Effect& effect, Set set) {
  return effect.changes ? sets_.changed(set, effect.values) : set;
}

Environments::Set Environments::before(const Effect& effect, Set set) {
  const Set reached = effect.changes ? sets_.before_change(set, effect.values) : set;
  return sets_.both(reached, effect.condition);
}

Environments::Set Environments::after_fault(Set set) {
  return sets_.one_changed(sets_.both(set, room_), all_faults_, true);
}
Environments::Set Environments::before_fault(Set set) {
  return sets_.both(sets_.one_changed(set, all_faults_, false), room_);
}
Environments::Set Environments::after_repair(std::uint32_t group, Set set) {
  return sets_.one_changed(set, faults_of_group_[group], false);
}
Environments::Set Environments::before_repair(std::uint32_t group, Set set) {
  return sets_.one_changed(set, faults_of_group_[group], true);
}

std::uint64_t Environments::count_faults(Set set) {
  std::uint64_t count = 0;
  for (std::size_t faults = 0; faults + 1 < exactly_.size(); ++faults) {
    count +=
        sets_.count(sets_.both(set, exactly_[faults])) * (model_.layout().faulty_count - faults);
  }
  return count;
}

std::uint64_t Environments::count_repairs(Set set) {
  std::uint64_t count = 0;
  for (std::size_t faults = 1; faults < exactly_.size(); ++faults) {
    count += sets_.count(sets_.both(set, exactly_[faults])) * faults;
  }
  return count;
}

}  // namespace cbc
