// An older catalog is read into a few lists, and written anew from them, as almost nothing of it
// stands where it has to stand: what was said of a behavior is said of its task. Edits of the old
// text would have to move most of it.

#include "core/catalog/older_format.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "core/support/wording.h"
#include "core/yaml/source.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::in_quotes;
using yaml::Kind;
using yaml::Node;

using Words = std::span<const std::string_view>;

constexpr std::string_view descriptor_sections[] = {"behavior_descriptors", "basic_behaviors"};
constexpr std::string_view capability_sections[] = {"capability_descriptors", "behavior_lists"};
constexpr std::string_view capability_keys[] = {"capabilities", "incompatible_lists"};
constexpr std::string_view precedence_section = "precedence_constraints";
constexpr std::string_view system_key = "system";

bool is_among(std::string_view word, Words words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A list of other values belongs to another program.
bool is_list_of_entries(const Node& node) {
  return node.kind == Kind::null ||
         (node.kind == Kind::sequence &&
          std::all_of(node.items.begin(), node.items.end(),
                      [](const Node* item) { return item->kind == Kind::mapping; }));
}

const Node* find_section(const Node& root, Words sections) {
  for (const auto& [key, value] : root.entries) {
    if (is_among(key->text, sections) && is_list_of_entries(*value)) return key;
  }
  return nullptr;
}

bool has_task(const Node& behavior) {
  return behavior.find("task") != nullptr || behavior.find("tasks") != nullptr;
}

/// The first of some keys in the entries of a list of behaviors that have no task. Beside a task,
/// such a key is just unknown.
const Node* find_in_entries(const Node* behaviors, Words keys, Kind kind) {
  if (behaviors == nullptr) return nullptr;
  for (const Node* behavior : behaviors->items) {
    if (has_task(*behavior)) continue;
    for (const auto& [key, value] : behavior->entries) {
      if (value->kind == kind && is_among(key->text, keys)) return key;
    }
  }
  return nullptr;
}

/// Whether a list of behaviors has none with a task.
bool lacks_tasks(const Node* behaviors) {
  return behaviors == nullptr || std::none_of(behaviors->items.begin(), behaviors->items.end(),
                                              [](const Node* item) { return has_task(*item); });
}

}  // namespace

std::optional<OlderFormat> find_older_format(const yaml::Node& root) {
  const Node* const descriptors = find_section(root, descriptor_sections);
  const Node* const of_capabilities = find_section(root, capability_sections);
  const Node* precedences = find_section(root, std::array{precedence_section});
  const Node* const behaviors = root.find("behaviors");
  if (!lacks_tasks(behaviors)) precedences = nullptr;
  const Node* list = behaviors;
  if (descriptors != nullptr) list = root.find(descriptors->text);
  const Node* const with_capabilities = find_in_entries(list, capability_keys, Kind::sequence);
  const Node* const with_system = find_in_entries(list, std::array{system_key}, Kind::scalar);

  OlderFormat format;
  for (const Node* key :
       {descriptors, of_capabilities, precedences, with_capabilities, with_system}) {
    if (format.key == nullptr) format.key = key;
  }
  if (format.key == nullptr) return std::nullopt;
  if (of_capabilities != nullptr || with_capabilities != nullptr) {
    format.features = "with capabilities and without tasks";
  } else if (precedences != nullptr || with_system != nullptr) {
    format.features = "with behavior systems and precedence constraints, and without tasks";
  } else if (descriptors != nullptr && descriptors->text == descriptor_sections[1]) {
    format.features = "with basic behaviors and without tasks";
  } else {
    format.features = "with behavior descriptors and without tasks";
  }
  return format;
}

namespace {

/// Why there is no conversion.
struct Obstacle {
  Leftover why;
};

/// A name of a behavior or a capability, and where it stands.
struct Mention {
  std::string name;
  Range range;
};

/// A scalar as it may stand anywhere, also in brackets.
std::string written(std::string_view text) {
  const auto is_letter_or_digit = [](char byte) {
    return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
           (byte >= '0' && byte <= '9') || byte == '_';
  };
  const bool begins_well =
      !text.empty() && (is_letter_or_digit(text[0]) ||
                        (text[0] == '-' && text.size() > 1 && is_letter_or_digit(text[1])));
  const bool is_simple =
      begins_well && std::all_of(text.begin(), text.end(), [&](char byte) {
        return is_letter_or_digit(byte) || byte == '.' || byte == '-' || byte == '/' || byte == '+';
      });
  return is_simple ? std::string(text) : in_quotes(text);
}

std::string written(const Node& node) {
  switch (node.kind) {
    case Kind::null:
      return "~";
    case Kind::scalar:
      return node.plain ? written(node.text) : in_quotes(node.text);
    case Kind::sequence:
      return "[" + join(node.items, ", ", [](const Node* item) { return written(*item); }) + "]";
    case Kind::mapping:
      break;
  }
  return "{" +
         join(node.entries, ", ",
              [](const auto& entry) {
                return written(*entry.first) + ": " + written(*entry.second);
              }) +
         "}";
}

/// The comments of a text by the entries that they are about: one at the end of a line by the entry
/// that this line is part of, others by the entry below them.
class Comments {
 public:
  /// `entries`: the lines in which they begin. `first_key`: the line of the first key.
  Comments(std::string_view text, const yaml::Document& document,
           const std::set<std::uint32_t>& entries, std::uint32_t first_key) {
    text = utf8::without_byte_order_mark(text);
    std::uint32_t number = 0;
    for (const yaml::SourceLine& line : yaml::split_lines(text, &document)) {
      ++number;
      if (!line.comment) continue;
      std::string_view comment = text.substr(*line.comment, line.end - *line.comment);
      while (!comment.empty() && yaml::is_blank(comment.back())) comment.remove_suffix(1);
      std::string& place = place_of(entries, first_key, number, line.has_content);
      place += comment;
      place += '\n';
    }
  }

  [[nodiscard]] const std::string& head() const { return head_; }
  [[nodiscard]] const std::string& tail() const { return tail_; }
  /// Those of the entry that begins in a line; none for the second entry of the line.
  [[nodiscard]] std::string take(std::uint32_t line) { return std::exchange(by_entry_[line], {}); }

 private:
  std::string& place_of(const std::set<std::uint32_t>& entries, std::uint32_t first_key,
                        std::uint32_t line, bool has_content) {
    if (line < first_key) return head_;
    auto entry = entries.lower_bound(line);
    if (has_content) {
      entry = entries.upper_bound(line);
      if (entry == entries.begin()) return head_;
      --entry;
    }
    return entry == entries.end() ? tail_ : by_entry_[*entry];
  }

  std::string head_;
  std::string tail_;
  std::map<std::uint32_t, std::string> by_entry_;
};

class Converter {
 public:
  Converter(const yaml::Document& document, std::string_view text)
      : document_(document), text_(text) {}

  Conversion convert() && {
    Conversion conversion;
    try {
      read();
      conversion.text = write();
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
  /// A behavior of the present catalog and its task, which have one name.
  struct Item {
    std::string name;
    std::uint32_t line = 0;
    const Node* timeout = nullptr;
    const Node* goal = nullptr;
    const Node* package = nullptr;
    std::optional<bool> is_reactive;
    bool is_capability = false;
    bool is_required = false;
    std::vector<std::string> required;
    std::vector<std::string> parameters;  ///< lines of the catalog
    std::vector<std::string> kept;        ///< "x-KEY: VALUE"
  };
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
    if (items_.empty()) refuse(root.range, "it has no behaviors");
    add_capabilities();
    resolve_lists();
    resolve_exclusions();
    resolve_precedences();
  }

  void read_section(const Node& key, const Node& value) {
    if (key.text == "default_values" || key.text == "default_behavior_values") {
      read_defaults(key, value);
    } else if (is_among(key.text, descriptor_sections) || key.text == "behaviors") {
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
      keep_unknown(key, value, kept_);
    }
  }

  void add_line(const Node& entry) { other_lines_.insert(entry.range.begin.line); }

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
        if (!read_attribute(*key, *given, defaults_)) {
          leave(key->range,
                quote(key->text) + " in " + quote(section.text) + " is not known, and left out");
        }
      }
    }
  }

  /// Whether a key is one of those that behaviors and their defaults have.
  bool read_attribute(const Node& key, const Node& value, Item& item) {
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

  Item& add_item(const Mention& name, const Node& entry) {
    Item& item = items_.emplace_back();
    item.name = name.name;
    item.line = entry.range.begin.line;
    return item;
  }

  void read_behavior(const Node& section, const Node& entry) {
    const Mention name = name_of(section, entry, "behavior");
    if (has_task(entry)) refuse(name.range, "behavior " + quote(name.name) + " has a task already");
    Item& item = add_item(name, entry);
    names_.try_emplace(name.name, items_.size() - 1);
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

  void read_arguments(const Node& key, const Node& value, Item& item) {
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
    Item& item = add_item(name, entry);
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
    for (Item& item : items_) {
      if (!item.is_capability) continue;
      known.insert(item.name);
      for (std::string& required : item.required) wanted_by_capabilities_.push_back(required);
    }
    std::vector<std::string> missing;
    const auto want = [&](const std::string& capability) {
      if (known.insert(capability).second) missing.push_back(capability);
    };
    for (const std::string& capability : wanted_by_capabilities_) want(capability);
    for (const Item& item : items_) {
      if (item.is_capability) continue;
      for (const Mention& capability : wanted_[item.name]) want(capability.name);
    }
    for (const auto& [one, other] : incompatible_) want(other);
    for (Item& item : items_) {
      if (item.is_capability) {
        for (std::string& required : item.required) required = present_name(required);
        continue;
      }
      for (const Mention& capability : wanted_[item.name]) {
        item.required.push_back(present_name(capability.name));
      }
    }
    for (const std::string& capability : missing) {
      Item& item = items_.emplace_back();
      item.name = capability;
      item.is_capability = true;
    }
    for (Item& item : items_) {
      if (item.is_capability) item.name = present_name(item.name);
    }
    for (const auto& [one, other] : incompatible_) {
      exclude_pair(present_name(one), present_name(other));
    }
  }

  /// Takes a list of tasks of which at most one may run, unless it says nothing.
  void exclude(std::vector<std::string> tasks) {
    if (tasks.size() < 2) return;
    for (const std::string& task : tasks) lists_of_[task].insert(exclusive_.size());
    exclusive_.push_back(std::move(tasks));
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
      kept_precedences_.push_back(
          "{active: [" + join(active, ", ", [](const std::string& name) { return written(name); }) +
          "], before: [" +
          join(unconverted, ", ", [](const std::string& name) { return written(name); }) + "]}");
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
    items_[names_.at(behavior)].required.push_back(task);
  }

  // Writing ----------------------------------------------------------------------------------

  std::string write() {
    std::set<std::string> required;
    for (const Item& item : items_) required.insert(item.required.begin(), item.required.end());
    for (Item& item : items_) item.is_required = required.contains(item.name);

    std::set<std::uint32_t> lines = other_lines_;
    for (const Item& item : items_) lines.insert(item.line);
    lines.erase(0);
    Comments comments(text_, document_, lines, document_.root().range.begin.line);
    std::string out = comments.head();
    write_defaults(out);
    out += "behaviors:\n";
    for (const Item& item : items_) {
      out += comments.take(item.line);
      write_behavior(item, out);
    }
    out += "tasks:\n";
    for (const Item& item : items_) write_task(item, out);
    for (const std::uint32_t line : other_lines_) out += comments.take(line);
    if (!exclusive_.empty()) out += "exclusivity_constraints:\n";
    for (const std::vector<std::string>& tasks : exclusive_) {
      out += "- mutually_exclusive: [" +
             join(tasks, ", ", [](const std::string& task) { return written(task); }) + "]\n";
    }
    if (!kept_precedences_.empty()) out += "x-precedence_constraints:\n";
    for (const std::string& precedence : kept_precedences_) out += "- " + precedence + "\n";
    for (const std::string& line : kept_) out += line + "\n";
    return with_line_ends(out + comments.tail());
  }

  /// Ends lines as the old text does.
  [[nodiscard]] std::string with_line_ends(const std::string& text) const {
    if (text_.find("\r\n") == std::string_view::npos) return text;
    std::string result;
    for (const char byte : text) {
      if (byte == '\n') result += '\r';
      result += byte;
    }
    return result;
  }

  static std::string_view goal_of(const Node& category) {
    return category.text == "recurrent" ? "keep_running" : "achieve_goal";
  }

  void write_defaults(std::string& out) const {
    if (defaults_.goal == nullptr && defaults_.timeout == nullptr) return;
    out += "default_values:\n  tasks:\n";
    if (defaults_.goal != nullptr) {
      out += "    execution_goal: " + std::string(goal_of(*defaults_.goal)) + "\n";
    }
    if (defaults_.timeout != nullptr) out += "    timeout: " + written(*defaults_.timeout) + "\n";
  }

  static void write_behavior(const Item& item, std::string& out) {
    out += "- behavior: " + written(item.name) + "\n";
    if (item.package != nullptr) out += "  package: " + written(*item.package) + "\n";
    out += "  task: " + written(item.name) + "\n";
    if (!item.required.empty()) out += "  requires:\n";
    for (const std::string& task : item.required) out += "  - task: " + written(task) + "\n";
    for (const std::string& line : item.kept) out += "  " + line + "\n";
  }

  void write_task(const Item& item, std::string& out) const {
    out += "- task: " + written(item.name) + "\n";
    if (item.is_capability) {
      out += "  execution_goal: keep_running\n";
    } else if (item.goal != nullptr) {
      out += "  execution_goal: " + std::string(goal_of(*item.goal)) + "\n";
    }
    const bool is_reactive =
        !item.is_capability && item.is_reactive.value_or(defaults_.is_reactive.value_or(false));
    if (is_reactive) out += "  reactive_start: TRUE\n";
    if (is_reactive || item.is_required || item.is_capability) {
      out += "  start_on_request: FALSE\n";
    }
    if (item.timeout != nullptr) out += "  timeout: " + written(*item.timeout) + "\n";
    if (!item.parameters.empty()) out += "  parameters:\n";
    for (const std::string& line : item.parameters) out += "  " + line + "\n";
  }

  const yaml::Document& document_;
  std::string_view text_;
  Item defaults_;
  std::vector<Item> items_;
  std::map<std::string, std::size_t> names_;            ///< places of behaviors among the items
  std::map<std::string, std::vector<Mention>> wanted_;  ///< capabilities, by behavior
  std::vector<std::string> wanted_by_capabilities_;
  std::map<std::string, std::vector<Mention>> naming_;  ///< behaviors, by the list that they name
  std::vector<std::pair<std::string, std::string>> incompatible_;
  std::vector<BehaviorList> lists_;
  std::vector<std::vector<Mention>> exclusions_;
  std::vector<Precedence> precedences_;
  std::vector<std::vector<std::string>> exclusive_;
  std::map<std::string, std::set<std::size_t>> lists_of_;  ///< those of exclusive_, by task
  std::size_t pairs_ = 0;
  std::set<std::pair<std::string, std::string>> required_;  ///< tasks of precedences, by behavior
  std::vector<std::string> kept_;                           ///< at the top of the catalog
  std::vector<std::string> kept_precedences_;
  std::set<std::uint32_t> other_lines_;  ///< of entries that are not behaviors
  std::map<std::string, Found> leftovers_;
};

}  // namespace

Conversion convert_older_format(const yaml::Document& document, std::string_view text) {
  return Converter(document, text).convert();
}

}  // namespace cbc
