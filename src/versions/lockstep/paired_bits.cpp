#include "versions/lockstep/paired_bits.h"

#include <algorithm>
#include <bit>
#include <map>

namespace cbc {

PairedBits::PairedBits(const ModelPair& models) {
  of_new.variables.resize(models.new_model.variables().size());
  of_old.variables.resize(models.old_model.variables().size());
  of_new.own.resize(models.new_model.own_flags().size(), none);
  of_old.own.resize(models.old_model.own_flags().size(), none);
  of_new.fault.resize(models.new_model.layout().faulty_count, none);
  of_old.fault.resize(models.old_model.layout().faulty_count, none);
  add_variables(models);
  add_own_flags(models);
  add_failures(models);
  add_faults(models);
  of_old.count = of_new.count;
}

void PairedBits::add_variables(const ModelPair& models) {
  const Translation& to_old = models.translations.to_old;
  for (std::uint32_t place = 0; place < of_new.variables.size(); ++place) {
    const Model::Variable& variable = models.new_model.variables()[place];
    const std::uint32_t known = to_old.variables[variable.id];
    const std::uint32_t other = known == none ? none : models.old_model.find_variable(known);
    if (variable.cell == none || other == none) continue;
    const Model::Variable& old_variable = models.old_model.variables()[other];
    if (old_variable.cell == none) continue;
    EnvironmentBits::Variable& bits = of_new.variables[place];
    EnvironmentBits::Variable& old_bits = of_old.variables[other];
    bits.codes.resize(variable.values, none);
    old_bits.codes.resize(old_variable.values, none);
    for (std::uint32_t value = 0; value < variable.values; ++value) {
      const std::uint32_t of_old_one = to_old.values[variable.id][value];
      if (of_old_one == none) continue;
      bits.codes[value] = value;
      old_bits.codes[of_old_one] = value;
    }
    const bool is_same_at_first =
        to_old.values[variable.id][variable.initial] == old_variable.initial;
    bits.first = of_new.count;
    bits.code_at_first = is_same_at_first ? variable.initial : variable.values;
    bits.width = static_cast<std::uint32_t>(
        std::bit_width(std::max(variable.values - 1, bits.code_at_first)));
    of_new.count += bits.width;
    old_bits.first = bits.first;
    old_bits.code_at_first = bits.code_at_first;
    old_bits.width = bits.width;
  }
}

void PairedBits::add_own_flags(const ModelPair& models) {
  const auto& old_flags = models.old_model.own_flags();
  for (std::uint32_t flag = 0; flag < of_new.own.size(); ++flag) {
    const BehaviorId known =
        models.translations.to_old.behaviors[models.new_model.own_flags()[flag].id];
    const auto other = std::find_if(old_flags.begin(), old_flags.end(),
                                    [&](const auto& one) { return one.id == known; });
    if (other == old_flags.end()) continue;
    of_new.own[flag] = of_new.count++;
    of_old.own[static_cast<std::size_t>(other - old_flags.begin())] = of_new.own[flag];
  }
}

void PairedBits::add_failures(const ModelPair& models) {
  for (std::uint32_t left = models.new_model.layout().failed_count; left > 0; --left) {
    of_new.failed.push_back(of_new.count++);
  }
  for (std::uint32_t left = models.old_model.layout().failed_count; left > 0; --left) {
    of_old.failed.push_back(of_new.count++);
  }
}

/// Repairs of a kind put the same reactive tasks into both queues.
void PairedBits::add_faults(const ModelPair& models) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> kind_of_groups;
  for (const ModelPair::PairedMove& move : models.moves) {
    if (move.move.kind != Move::Kind::fault) continue;
    const Model::Behavior& behavior = models.new_model.behaviors()[move.of_new->subject];
    const Model::Behavior& old_behavior = models.old_model.behaviors()[move.of_old->subject];
    of_new.fault[behavior.fault] = of_new.count++;
    of_old.fault[old_behavior.fault] = of_new.fault[behavior.fault];
    const auto [entry, is_new] = kind_of_groups.try_emplace(
        {behavior.group, old_behavior.group}, static_cast<std::uint32_t>(repaired.size()));
    if (is_new) repaired.emplace_back(move.of_new->subject, move.of_old->subject);
    kinds.push_back(entry->second);
  }
}

}  // namespace cbc
