// Renames are found by content. Things that only one of the catalogs has are paired if all that is
// said of them is the same, where a name that only one catalog has counts as any such name; a
// content that several have pairs none. Then pairs are taken back whose contents differ once the
// new names are put in place of the old ones, until all that are left agree with one another.

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/base/text.h"
#include "versions/difference/catalog_diff.h"
#include "versions/difference/catalog_facts.h"

namespace cbc {
namespace {

using Names = std::set<std::string_view>;

/// More would take long, and is another catalog rather than a newer one.
constexpr std::size_t most_new_things = 1000;
constexpr std::size_t most_rounds = 20;

constexpr std::array subjects = {ChangeSubject::task, ChangeSubject::behavior,
                                 ChangeSubject::variable};

/// By subject, for tasks, behaviors and variables.
using NamesOfKinds = std::map<ChangeSubject, Names>;

NamesOfKinds names_of(const NamedCatalog& named) {
  return {{ChangeSubject::task, {named.tasks.begin(), named.tasks.end()}},
          {ChangeSubject::behavior, {named.behaviors.begin(), named.behaviors.end()}},
          {ChangeSubject::variable, {named.variables.begin(), named.variables.end()}}};
}

NamesOfKinds without(NamesOfKinds names, const NamesOfKinds& others) {
  for (auto& [subject, all] : names) {
    const Names& of_others = others.at(subject);
    std::erase_if(all, [&](std::string_view name) { return of_others.contains(name); });
  }
  return names;
}

std::size_t count(const NamesOfKinds& names) {
  std::size_t total = 0;
  for (const auto& [subject, all] : names) total += all.size();
  return total;
}

std::string describe(const Attributes& attributes) {
  std::string text;
  for (const Attribute& attribute : attributes) {
    text += concat(attribute.name, "=", attribute.value.index(), ":");
    std::visit(
        [&text](const auto& value) {
          using Value = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<Value, std::string>) {
            text += quote(value);
          } else if constexpr (!std::is_same_v<Value, std::monostate>) {
            text += std::to_string(value);
          }
        },
        attribute.value);
    text += ";";
  }
  return text;
}

/// All that a catalog says of some of its things.
class Contents {
 public:
  /// `things` are these; a name in `any` counts as any name.
  Contents(const NamedCatalog& named, const NamesOfKinds& things, const NamesOfKinds& any)
      : named_(named), things_(things), any_(any) {
    for (const ChangeSubject subject : subjects) {
      for (const Fact& fact : facts(named, subject)) add_thing(subject, fact);
    }
    for (const Fact& fact : facts(named, ChangeSubject::performs)) add_pair("performs", fact);
    for (const Fact& fact : facts(named, ChangeSubject::requirement)) add_pair("requires", fact);
    add_exclusions();
    for (auto& [thing, lines] : lines_) std::sort(lines.begin(), lines.end());
  }

  [[nodiscard]] const std::vector<std::string>& of(ChangeSubject subject, std::string_view name) {
    return lines_[{subject, name}];
  }

 private:
  using Thing = std::pair<ChangeSubject, std::string_view>;

  void add(ChangeSubject subject, std::string_view name, std::string line) {
    if (things_.at(subject).contains(name)) lines_[{subject, name}].push_back(std::move(line));
  }

  [[nodiscard]] std::string shown(ChangeSubject subject, std::string_view name) const {
    return any_.at(subject).contains(name) ? "?" : quote(name);
  }

  void add_thing(ChangeSubject subject, const Fact& fact) {
    Attributes own;
    for (const Attribute& attribute : fact.attributes) {
      if (subject != ChangeSubject::behavior || !attribute.name.starts_with(condition_prefix)) {
        own.push_back(attribute);
        continue;
      }
      const auto found = std::find_if(
          named_.variables.begin(), named_.variables.end(), [&](std::string_view variable) {
            return attribute.name.substr(condition_prefix.size()) == variable;
          });
      const std::string values = describe({{"values", attribute.value}});
      add(subject, fact.first, concat("fits ", shown(ChangeSubject::variable, *found), values));
      add(ChangeSubject::variable, *found,
          concat(shown(ChangeSubject::behavior, fact.first), " fits ", values));
    }
    add(subject, fact.first, describe(own));
  }

  void add_pair(std::string_view verb, const Fact& fact) {
    const std::string attributes = describe(fact.attributes);
    add(ChangeSubject::behavior, fact.first,
        concat(std::string(verb), shown(ChangeSubject::task, fact.second), attributes));
    add(ChangeSubject::task, fact.second,
        concat(shown(ChangeSubject::behavior, fact.first), std::string(verb), attributes));
  }

  void add_exclusions() {
    for (TaskId task(0); task < named_.tasks.size(); ++task) {
      if (!things_.at(ChangeSubject::task).contains(named_.tasks[task])) continue;
      std::set<TaskId> excluded;
      for (const std::uint32_t clique : named_.catalog.task_cliques[task]) {
        for (const TaskId other : named_.catalog.cliques[clique]) excluded.insert(other);
      }
      excluded.erase(task);
      for (const TaskId other : excluded) {
        add(ChangeSubject::task, named_.tasks[task],
            "excludes " + shown(ChangeSubject::task, named_.tasks[other]));
      }
    }
  }

  const NamedCatalog& named_;
  const NamesOfKinds& things_;
  const NamesOfKinds& any_;
  std::map<Thing, std::vector<std::string>> lines_;
};

/// Adds the numbers of a pair of names.
void add(const CompiledCatalog& before, const CompiledCatalog& after, ChangeSubject subject,
         std::string_view from, std::string_view to, Renames& renames) {
  switch (subject) {
    case ChangeSubject::task:
      renames.tasks.emplace_back(*task_called(before, from), *task_called(after, to));
      break;
    case ChangeSubject::behavior:
      renames.behaviors.emplace_back(*behavior_called(before, from), *behavior_called(after, to));
      break;
    default:
      renames.variables.emplace_back(*variable_called(before, from), *variable_called(after, to));
  }
}

struct Pair {
  ChangeSubject subject = ChangeSubject::task;
  std::string_view from;
  std::string_view to;
};

/// Pairs what has the same content, if nothing else has it.
std::vector<Pair> pair_by_content(const NamesOfKinds& gone, Contents& old_contents,
                                  const NamesOfKinds& added, Contents& new_contents) {
  using Content = std::pair<ChangeSubject, std::vector<std::string>>;
  std::map<Content, std::pair<std::vector<std::string_view>, std::vector<std::string_view>>> found;
  for (const ChangeSubject subject : subjects) {
    for (const std::string_view name : gone.at(subject)) {
      const Content content(subject, old_contents.of(subject, name));
      found[content].first.push_back(name);
    }
    for (const std::string_view name : added.at(subject)) {
      const Content content(subject, new_contents.of(subject, name));
      found[content].second.push_back(name);
    }
  }
  std::vector<Pair> pairs;
  for (const auto& [content, names] : found) {
    const auto& [from, to] = names;
    if (from.size() == 1 && to.size() == 1) pairs.push_back({content.first, from[0], to[0]});
  }
  return pairs;
}

}  // namespace

Renames find_renames(const CompiledCatalog& before, const CompiledCatalog& after,
                     const Renames& given) {
  const NamedCatalog new_names = with_own_names(after);
  const NamedCatalog old_names = with_new_names(before, after, given);
  const NamesOfKinds gone = without(names_of(old_names), names_of(new_names));
  const NamesOfKinds added = without(names_of(new_names), names_of(old_names));
  if (count(gone) == 0 || count(added) == 0) return given;
  if (std::max(count(gone), count(added)) > most_new_things) return given;
  Contents loose_old(old_names, gone, gone);
  Contents loose_new(new_names, added, added);
  std::vector<Pair> pairs = pair_by_content(gone, loose_old, added, loose_new);

  const NamesOfKinds none_of_all = {
      {ChangeSubject::task, {}}, {ChangeSubject::behavior, {}}, {ChangeSubject::variable, {}}};
  Contents contents(new_names, added, none_of_all);
  for (std::size_t round = 0; round < most_rounds; ++round) {
    Renames renames = given;
    for (const Pair& pair : pairs) add(before, after, pair.subject, pair.from, pair.to, renames);
    const NamedCatalog renamed = with_new_names(before, after, renames);
    Contents old_contents(renamed, added, none_of_all);
    const std::size_t taken_back = std::erase_if(pairs, [&](const Pair& pair) {
      return old_contents.of(pair.subject, pair.to) != contents.of(pair.subject, pair.to);
    });
    if (taken_back == 0) return renames;
  }
  return given;
}

}  // namespace cbc
