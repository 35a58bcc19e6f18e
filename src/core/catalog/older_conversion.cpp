// An older catalog is read into a few lists. When all names are known, capabilities become items
// beside the behaviors, and what the lists say becomes requirements and exclusions of items.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/catalog/older_catalog.h"
#include "core/catalog/older_format.h"
#include "core/support/wording.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using older::has_task;
using older::is_list_of_entries;
using older::precedence_section;
using older::system_key;
using older::written;
using yaml::Kind;
using yaml::Node;

/// Why there is no conversion.
struct Obstacle {
  Leftover why;
};

bool is_descriptor_section(std::string_view key) {
  return std::find(std::begin(older::descriptor_sections), std::end(older::descriptor_sections),
                   key) != std::end(older::descriptor_sections);
}

/// A name of a behavior or a capability, and where it stands.
struct Mention {
  std::string name;
  Range range;
};

class Converter {
 public:
  Converter(const yaml::Document& document, std::string_view text)
      : document_(document), text_(text) {}

  Conversion convert() && {
    Conversion conversion;
    try {
      read();
      conversion.text = older::write(catalog_, document_, text_);
    } catch (const Obstacle& obstacle) {
      conversion.obstacle = obstacle.why;
    }
    for (const auto& [message, found] : leftovers_) {
      std::string text = message;
      if (found.count > 1) text += " (" + std::to_string(found.count) + " times)";
      conversion.leftovers.push_back({found.range, std::move(text)});
    }
    std::stable_sort(
        conversion.leftovers.begin(), conversion.leftovers.end(),
        [](const Leftover& a, const Leftover& b) { return a.range.begin < b.range.begin; });
    return conversion;
  }

 private:
  struct BehaviorList {
    Mention name;
    std::vector<Mention> members;
  };
  struct Precedence {
    const Node* entry = nullptr;
    std::vector<Mention> active;
    std::vector<Mention> before;
  };
  struct Found {
    Range range;
    std::size_t count = 0;
  };

  void leave(const Range& range, const std::string& message) {
    Found& found = leftovers_[message];
    if (found.count++ == 0) found.range = range;
  }

  [[noreturn]] static void refuse(const Range& range, std::string why) {
    throw Obstacle{{range, std::move(why)}};
  }

  void keep(const Node& key, const Node& value, std::vector<std::string>& kept,
            const std::string& why) {
    const bool is_own = key.text.starts_with("x-");
    kept.push_back(written(is_own ? key.text : "x-" + key.text) + ": " + written(value));
    if (!is_own) {
      leave(key.range, quote(key.text) + " " + why + "; it is kept as " + quote("x-" + key.text));
    }
  }

  void keep_unknown(const Node& key, const Node& value, std::vector<std::string>& kept) {
    keep(key, value, kept, "is not known");
  }

  // Reading ----------------------------------------------------------------------------------

  void read() {
    const Node& root = document_.root();
    for (const auto& [key, value] : root.entries) read_section(*key, *value);
    if (catalog_.items.empty()) refuse(root.range, "it has no behaviors");
    add_capabilities();
    resolve_lists();
    resolve_exclusions();
    resolve_precedences();
  }

  void read_section(const Node& key, const Node& value) {
    if (key.text == "default_values" || key.text == "default_behavior_values") {
      read_defaults(key, value);
    } else if (is_descriptor_section(key.text) || key.text == "behaviors") {
      for (const Node* entry : entries_of(key, value)) read_behavior(key, *entry);
    } else if (key.text == "capability_descriptors") {
      for (const Node* entry : entries_of(key, value)) read_capability(key, *entry);
    } else if (key.text == "behavior_lists") {
      for (const Node* entry : entries_of(key, value)) {
        lists_.push_back({name_of(key, *entry, "list"), names_in(entry->find("behaviors"))});
        add_line(*entry);
      }
    } else if (key.text == "exclusivity_constraints") {
      for (const Node* entry : entries_of(key, value)) {
        exclusions_.push_back(names_in(entry->find("mutually_exclusive")));
        add_line(*entry);
      }
    } else if (key.text == precedence_section) {
      for (const Node* entry : entries_of(key, value)) {
        precedences_.push_back(
            {entry, names_in(entry->find("active")), names_in(entry->find("before"))});
        add_line(*entry);
      }
    } else if (key.text == "tasks") {
      refuse(key.range, "it has a section 'tasks' as well");
    } else {
      keep_unknown(key, value, catalog_.kept);
    }
  }

  void add_line(const Node& entry) { catalog_.other_lines.insert(entry.range.begin.line); }

  static std::vector<const Node*> entries_of(const Node& key, const Node& value) {
    if (!is_list_of_entries(value)) {
      refuse(value.range, quote(key.text) + " is no list of mappings");
    }
    return value.items;
  }

  static Mention name_of(const Node& section, const Node& entry, std::string_view key) {
    const Node* const name = entry.find(key);
    if (name == nullptr || name->kind != Kind::scalar || name->text.empty()) {
      refuse(entry.range, "an entry of " + quote(section.text) + " has no " + quote(key));
    }
    return {name->text, name->range};
  }

  std::vector<Mention> names_in(const Node* node) {
    std::vector<Mention> names;
    if (node == nullptr) return names;
    const std::vector<const Node*> single{node};
    std::set<std::string_view> known;
    for (const Node* item : node->kind == Kind::sequence ? node->items : single) {
      if (item->kind != Kind::scalar) refuse(item->range, "a name is expected here");
      if (known.insert(item->text).second) names.push_back({item->text, item->range});
    }
    return names;
  }

  void read_defaults(const Node& section, const Node& value) {
    const std::vector<const Node*> single{&value};
    for (const Node* mapping : value.kind == Kind::sequence ? value.items : single) {
      if (mapping->kind == Kind::scalar) refuse(mapping->range, "a mapping is expected here");
      for (const auto& [key, given] : mapping->entries) {
        if (!read_attribute(*key, *given, catalog_.defaults)) {
          leave(key->range,
                quote(key->text) + " in " + quote(section.text) + " is not known, and left out");
        }
      }
    }
  }

  /// Whether a key is one of those that behaviors and their defaults have.
  bool read_attribute(const Node& key, const Node& value, older::Item& item) {
    if (key.text == "timeout") {
      item.timeout = &value;
    } else if (key.text == "category" &&
               (value.text == "goal_based" || value.text == "recurrent")) {
      item.goal = &value;
    } else if (key.text == "default" && yaml::to_boolean(value)) {
      item.is_reactive = yaml::to_boolean(value);
    } else {
      return false;
    }
    return true;
  }

  older::Item& add_item(const Mention& name, const Node& entry) {
    older::Item& item = catalog_.items.emplace_back();
    item.name = name.name;
    item.line = entry.range.begin.line;
    return item;
  }

  void read_behavior(const Node& section, const Node& entry) {
    const Mention name = name_of(section, entry, "behavior");
    if (has_task(entry)) refuse(name.range, "behavior " + quote(name.name) + " has a task already");
    older::Item& item = add_item(name, entry);
    names_.try_emplace(name.name, catalog_.items.size() - 1);
    for (const auto& [key, value] : entry.entries) {
      if (key->text == "behavior" || read_attribute(*key, *value, item)) continue;
      if (key->text == system_key || key->text == "package") {
        item.package = value;
      } else if (key->text == "capabilities") {
        for (const Mention& capability : names_in(value)) wanted_[name.name].push_back(capability);
      } else if (key->text == "incompatible_lists") {
        for (const Mention& list : names_in(value))
          naming_[list.name].push_back({name.name, list.range});
      } else if (key->text == "arguments" || key->text == "parameters") {
        read_arguments(*key, *value, item);
      } else {
        keep_unknown(*key, *value, item.kept);
      }
    }
  }

  void read_arguments(const Node& key, const Node& value, older::Item& item) {
    for (const Node* argument : entries_of(key, value)) {
      const std::string_view word =
          argument->find("argument") != nullptr ? "argument" : "parameter";
      const Mention name = name_of(key, *argument, word);
      item.parameters.push_back("- parameter: " + written(name.name));
      const Node* const dimensions = argument->find("dimensions");
      const bool is_single =
          dimensions == nullptr || dimensions->kind != Kind::scalar || dimensions->text == "1";
      const bool is_point = !is_single && (dimensions->text == "2" || dimensions->text == "3");
      if (is_point) item.parameters.emplace_back("  allowed_values: point");
      for (const auto& [part, given] : argument->entries) {
        const std::string line = written(part->text) + ": " + written(*given);
        if (part->text == word || (part->text == "dimensions" && is_single)) continue;
        if (part->text == "allowed_values" && is_single) {
          item.parameters.push_back("  " + line);
          continue;
        }
        std::vector<std::string> kept;
        keep(*part, *given, kept,
             is_single ? "is not known"
                       : "of an argument with several numbers cannot be said of a parameter, of "
                         "which only 'point' is known");
        item.parameters.push_back("  " + kept.front());
      }
    }
  }

  void read_capability(const Node& section, const Node& entry) {
    const Mention name = name_of(section, entry, "capability");
    older::Item& item = add_item(name, entry);
    item.is_capability = true;
    for (const auto& [key, value] : entry.entries) {
      if (key->text == "capability") continue;
      if (key->text == "required_capabilities") {
        for (Mention& capability : names_in(value)) item.required.push_back(capability.name);
      } else if (key->text == "incompatible_capabilities") {
        for (const Mention& other : names_in(value)) {
          incompatible_.emplace_back(name.name, other.name);
        }
      } else if (key->text == "process_sequence") {
        keep(*key, *value, item.kept,
             "has no place in a catalog: the program of the behavior has to start the processes");
      } else {
        keep_unknown(*key, *value, item.kept);
      }
    }
  }

  // Names ------------------------------------------------------------------------------------

  /// The name of the behavior that stands for a capability.
  [[nodiscard]] std::string present_name(const std::string& capability) const {
    return names_.contains(capability) ? capability + "_CAPABILITY" : capability;
  }

  /// Capabilities without a descriptor get an entry, and those that are required are noted.
  void add_capabilities() {
    std::set<std::string> known;
    for (older::Item& item : catalog_.items) {
      if (!item.is_capability) continue;
      known.insert(item.name);
      for (std::string& required : item.required) wanted_by_capabilities_.push_back(required);
    }
    std::vector<std::string> missing;
    const auto want = [&](const std::string& capability) {
      if (known.insert(capability).second) missing.push_back(capability);
    };
    for (const std::string& capability : wanted_by_capabilities_) want(capability);
    for (const older::Item& item : catalog_.items) {
      if (item.is_capability) continue;
      for (const Mention& capability : wanted_[item.name]) want(capability.name);
    }
    for (const auto& [one, other] : incompatible_) want(other);
    for (older::Item& item : catalog_.items) {
      if (item.is_capability) {
        for (std::string& required : item.required) required = present_name(required);
        continue;
      }
      for (const Mention& capability : wanted_[item.name]) {
        item.required.push_back(present_name(capability.name));
      }
    }
    for (const std::string& capability : missing) {
      older::Item& item = catalog_.items.emplace_back();
      item.name = capability;
      item.is_capability = true;
    }
    for (older::Item& item : catalog_.items) {
      if (item.is_capability) item.name = present_name(item.name);
    }
    for (const auto& [one, other] : incompatible_) {
      exclude_pair(present_name(one), present_name(other));
    }
  }

  /// Takes a list of tasks of which at most one may run, unless it says nothing.
  void exclude(std::vector<std::string> tasks) {
    if (tasks.size() < 2) return;
    for (const std::string& task : tasks) lists_of_[task].insert(catalog_.exclusive.size());
    catalog_.exclusive.push_back(std::move(tasks));
  }

  [[nodiscard]] bool excludes(const std::string& task, const std::string& other) const {
    const auto lists = lists_of_.find(task);
    const auto others = lists_of_.find(other);
    if (lists == lists_of_.end() || others == lists_of_.end()) return false;
    return std::any_of(lists->second.begin(), lists->second.end(),
                       [&](std::size_t list) { return others->second.contains(list); });
  }

  /// The same for two tasks, unless they exclude each other already.
  void exclude_pair(const std::string& task, const std::string& other) {
    constexpr std::size_t most_pairs = 100'000;
    if (task == other || excludes(task, other)) return;
    if (++pairs_ > most_pairs)
      refuse(document_.root().range, "too many behaviors are incompatible");
    exclude({task, other});
  }

  /// Those that are behaviors of the catalog.
  std::vector<std::string> known_of(const std::vector<Mention>& mentions) {
    std::vector<std::string> known;
    for (const Mention& mention : mentions) {
      if (names_.contains(mention.name)) {
        known.push_back(mention.name);
      } else {
        leave(mention.range, "behavior " + quote(mention.name) +
                                 " has no descriptor; it is left out of its lists");
      }
    }
    return known;
  }

  /// A behavior excludes all others of the lists that it names. One without a definition is taken
  /// to have those that name it.
  void resolve_lists() {
    for (const BehaviorList& list : lists_) {
      const std::vector<std::string> members = known_of(list.members);
      const auto found = naming_.find(list.name.name);
      if (found == naming_.end()) continue;
      const std::set<std::string_view> known(members.begin(), members.end());
      std::vector<std::string> both;
      for (const Mention& naming : found->second) {
        if (known.contains(naming.name)) both.push_back(naming.name);
      }
      exclude(both);
      for (const Mention& naming : found->second) {
        for (const std::string& member : members) exclude_pair(naming.name, member);
      }
      naming_.erase(found);
    }
    for (const auto& [name, naming] : naming_) {
      if (!lists_.empty()) {
        std::vector<std::string_view> names;
        for (const BehaviorList& list : lists_) names.push_back(list.name.name);
        leave(naming.front().range, "list " + quote(name) + " is not in 'behavior_lists'" +
                                        did_you_mean(nearest(name, names)));
      }
      std::vector<std::string> all;
      for (const Mention& mention : naming) all.push_back(mention.name);
      exclude(all);
    }
  }

  void resolve_exclusions() {
    for (const std::vector<Mention>& list : exclusions_) exclude(known_of(list));
  }

  /// A precedence demands that one of some behaviors is active before others are activated.
  void resolve_precedences() {
    for (const Precedence& precedence : precedences_) {
      const std::vector<std::string> active = known_of(precedence.active);
      const std::vector<std::string> before = known_of(precedence.before);
      std::vector<std::string> unconverted;
      for (const std::string& later : before) {
        const std::string obstacle =
            active.size() == 1 ? obstacle_to(active.front(), later) : obstacle_to_several(active);
        if (obstacle.empty()) {
          require(later, active.front());
          leave(precedence.entry->range,
                "a precedence becomes a requirement, which holds as long as the later behavior "
                "runs: it ends with the earlier one");
        } else {
          leave(precedence.entry->range,
                "this precedence is kept as 'x-precedence_constraints', not as a requirement: " +
                    obstacle);
          unconverted.push_back(later);
        }
      }
      if (unconverted.empty()) continue;
      catalog_.kept_precedences.push_back("{active: " + written(active) +
                                          ", before: " + written(unconverted) + "}");
    }
  }

  static std::string obstacle_to_several(const std::vector<std::string>& active) {
    if (active.empty()) return "no behavior is named that has to be active";
    return "one of several behaviors has to be active, while a behavior requires one task; where "
           "they are alternatives, let them perform the same task";
  }

  [[nodiscard]] std::string obstacle_to(const std::string& active, const std::string& later) const {
    if (active == later) return "a behavior cannot require itself";
    if (excludes(active, later)) {
      return quote(active) + " and " + quote(later) + " exclude each other";
    }
    return {};
  }

  void require(const std::string& behavior, const std::string& task) {
    if (!required_.insert({behavior, task}).second) return;
    catalog_.items[names_.at(behavior)].required.push_back(task);
  }

  const yaml::Document& document_;
  std::string_view text_;
  older::Converted catalog_;
  std::map<std::string, std::size_t> names_;            ///< places of behaviors among the items
  std::map<std::string, std::vector<Mention>> wanted_;  ///< capabilities, by behavior
  std::vector<std::string> wanted_by_capabilities_;
  std::map<std::string, std::vector<Mention>> naming_;  ///< behaviors, by the list that they name
  std::vector<std::pair<std::string, std::string>> incompatible_;
  std::vector<BehaviorList> lists_;
  std::vector<std::vector<Mention>> exclusions_;
  std::vector<Precedence> precedences_;
  std::map<std::string, std::set<std::size_t>> lists_of_;  ///< exclusive ones, by task
  std::size_t pairs_ = 0;
  std::set<std::pair<std::string, std::string>> required_;  ///< tasks of precedences, by behavior
  std::map<std::string, Found> leftovers_;
};

}  // namespace

Conversion convert_older_format(const yaml::Document& document, std::string_view text) {
  return Converter(document, text).convert();
}

}  // namespace cbc
