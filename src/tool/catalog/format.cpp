#include "catalog/format.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "support/wording.h"

namespace cbc {
namespace {

using yaml::Kind;
using yaml::Node;

/// A section at the top of a catalog, and the kinds of values that it has.
struct Section {
  std::string_view key;
  bool may_be_mapping = false;
};

constexpr std::string_view main_key = "behaviors";
constexpr Section other_sections[] = {
    {"tasks"}, {"situation"}, {"exclusivity_constraints"}, {"default_values", true}};

bool is_list_of_mappings(const Node& node) {
  return node.kind == Kind::sequence && !node.items.empty() &&
         std::all_of(node.items.begin(), node.items.end(),
                     [](const Node* item) { return item->kind == Kind::mapping; });
}

bool has_right_kind(const Section& section, const Node& value) {
  return is_list_of_mappings(value) || (section.may_be_mapping && value.kind == Kind::mapping);
}

bool is_misspelling(std::string_view key, std::string_view known) {
  constexpr std::size_t most_letters = 2;  // more is another name that has this one as a part
  const std::size_t longer = std::max(key.size(), known.size());
  return longer - std::min(key.size(), known.size()) <= most_letters &&
         nearest(key, std::vector<std::string_view>{known}).has_value();
}

using IsKey = bool (*)(std::string_view key, std::string_view known);

/// Whether a mapping has the sections of a catalog.
bool has_sections(const Node& root, IsKey is_key) {
  std::size_t others = 0;
  for (const auto& [key, value] : root.entries) {
    if (key->text == main_key) return true;
    if (is_key(key->text, main_key) && is_list_of_mappings(*value)) return true;
    for (const Section& section : other_sections) {
      if (is_key(key->text, section.key) && has_right_kind(section, *value)) ++others;
    }
  }
  return others >= 2;
}

bool is_the_key(std::string_view key, std::string_view known) { return key == known; }

bool is_about_the_key(std::string_view key, std::string_view known) {
  return key == known || is_misspelling(key, known);
}

/// The key of a mapping that has one of some names and a list for its value.
template <typename Names>
const Node* find_list(const Node& mapping, const Names& names) {
  for (const auto& [key, value] : mapping.entries) {
    if (value->kind == Kind::sequence &&
        std::find(std::begin(names), std::end(names), key->text) != std::end(names)) {
      return key;
    }
  }
  return nullptr;
}

}  // namespace

bool is_catalog(const yaml::Node& root) {
  return has_sections(root, is_the_key) || find_older_format(root) != nullptr;
}

bool resembles_catalog(const yaml::Node& root) {
  return is_catalog(root) || has_sections(root, is_about_the_key);
}

const yaml::Node* find_older_format(const yaml::Node& root) {
  constexpr std::string_view sections[] = {"behavior_descriptors", "capability_descriptors",
                                           "basic_behaviors"};
  constexpr std::string_view keys[] = {"capabilities", "incompatible_lists"};
  if (const Node* key = find_list(root, sections)) return key;
  const Node* behaviors = root.find(main_key);
  if (behaviors == nullptr) return nullptr;
  for (const Node* behavior : behaviors->items) {
    // Beside a task, such a key is just unknown.
    if (behavior->find("task") != nullptr || behavior->find("tasks") != nullptr) continue;
    if (const Node* key = find_list(*behavior, keys)) return key;
  }
  return nullptr;
}

}  // namespace cbc
