// A text that is not valid YAML has no keys, only words that stand where a key may stand: after
// white space, a dash or a bracket, and before a colon. Those of the text show what it was meant to
// be, whatever is wrong with it, be it a tab or another encoding. A word that files of other
// programs have as well counts only beside another one.

#include "core/files/recognition.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "cbc/event.h"
#include "core/catalog/shape.h"
#include "core/check/severity_settings.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/event_lines.h"
#include "core/support/wording.h"
#include "core/yaml/source.h"
#include "runtime/compiled/compiled_file.h"
#include "runtime/coordinator/record.h"

namespace cbc::cli {
namespace {

using Words = std::span<const std::string_view>;

constexpr std::string_view sections_of_catalogs[] = {"behaviors",
                                                     "behaviours",
                                                     "exclusivity_constraints",
                                                     "behavior_descriptors",
                                                     "basic_behaviors",
                                                     "behavior_lists",
                                                     "capability_descriptors",
                                                     "default_behavior_values",
                                                     "precedence_constraints"};
/// Sections that other files have as well.
constexpr std::string_view common_sections[] = {"tasks", "default_values", "situation"};
constexpr std::string_view entries_of_catalogs[] = {"task", "behavior", "variable",
                                                    "mutually_exclusive"};
constexpr std::string_view keys_of_scripts[] = {"events", "catalog"};
constexpr std::string_view expectation[] = {"expect"};
constexpr std::string_view keys_of_properties[] = {"properties", "assume", "initially"};
constexpr std::string_view kinds_of_properties[] = {"can_start", "always", "never", "reachable"};

/// The words of a text that stand where a key may stand.
class KeyWords {
 public:
  /// Keeps only words that are asked for below. `text` is not valid YAML.
  explicit KeyWords(std::string_view text) {
    // Without the zero bytes, keys in UTF-16 and UTF-32 are those in ASCII.
    std::string narrow;
    if (text.find('\0') != std::string_view::npos) {
      std::copy_if(text.begin(), text.end(), std::back_inserter(narrow),
                   [](char byte) { return byte != '\0'; });
      text = narrow;
    }
    bool may_begin = true;
    for (std::size_t at = 0; at < text.size();) {
      const char byte = text[at];
      if (byte == '#' && (at == 0 || yaml::is_blank(text[at - 1]))) {
        at = text.find_first_of("\r\n", at);
        if (at == std::string_view::npos) return;
      } else if (may_begin && is_letter(byte)) {
        at = take_word(text, at);
        may_begin = false;
      } else {
        may_begin = is_in(byte, "\r\n{[,?") || (may_begin && may_precede(byte));
        ++at;
      }
    }
  }

  [[nodiscard]] bool has_any(Words words) const { return count(words) > 0; }
  [[nodiscard]] std::size_t count(Words words) const {
    return static_cast<std::size_t>(
        std::count_if(words.begin(), words.end(),
                      [this](std::string_view word) { return found_.contains(word); }));
  }

 private:
  static bool is_in(char byte, std::string_view bytes) {
    return bytes.find(byte) != std::string_view::npos;
  }
  static bool is_letter(char byte) {
    return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || byte == '_';
  }
  /// White space, also what is none in YAML: no-break spaces, byte order marks.
  static bool is_space(char byte) {
    return static_cast<unsigned char>(byte) <= ' ' || static_cast<unsigned char>(byte) >= 0x7F;
  }
  static bool may_precede(char byte) { return is_space(byte) || is_in(byte, "-\"'"); }

  /// Takes the word that begins here if a colon follows. Returns where it ends.
  std::size_t take_word(std::string_view text, std::size_t begin) {
    std::size_t end = begin;
    while (end < text.size() && is_letter(text[end])) ++end;
    std::size_t colon = end;
    while (colon < text.size() && text[colon] != '\n' &&
           (is_space(text[colon]) || is_in(text[colon], "\"'"))) {
      ++colon;
    }
    if (colon == text.size() || text[colon] != ':') return end;
    const std::string_view word = text.substr(begin, end - begin);
    if (is_wanted(word)) found_.emplace(word);
    return end;
  }

  static bool is_wanted(std::string_view word) {
    const std::array<Words, 8> wanted = {
        sections_of_catalogs, common_sections,    entries_of_catalogs, keys_of_scripts,
        expectation,          keys_of_properties, kinds_of_properties, scripted_verb_words()};
    return std::any_of(wanted.begin(), wanted.end(), [word](Words words) {
      return std::find(words.begin(), words.end(), word) != words.end();
    });
  }

  std::set<std::string, std::less<>> found_;
};

bool has_any(const yaml::Node& node, Words keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&node](std::string_view key) { return node.find(key) != nullptr; });
}

/// Of a document that is no catalog.
bool is_property_file(const yaml::Node& root) {
  return std::any_of(root.entries.begin(), root.entries.end(), [](const auto& entry) {
    return entry.first->text == "properties" || entry.first->text == "assume";
  });
}

/// Of a document that is neither a catalog nor a property file.
bool is_script(const yaml::Node& root) {
  constexpr std::array<std::string_view, 4> keys = {"events", "catalog", "reactive_delay",
                                                    "timeouts"};
  constexpr std::array<std::string_view, 2> other_event_keys = {"expect", "at"};
  if (root.kind != yaml::Kind::sequence) {
    // In a catalog it is a list.
    const yaml::Node* const situation = root.find("situation");
    const bool has_situation = situation != nullptr && situation->kind == yaml::Kind::mapping;
    return has_any(root, keys) || has_situation;
  }
  // Another list is more likely a catalog that lacks a key.
  return root.items.empty() ||
         std::any_of(root.items.begin(), root.items.end(), [&](const yaml::Node* item) {
           return has_any(*item, scripted_verb_words()) || has_any(*item, other_event_keys);
         });
}

bool has_misspelt_events(const yaml::Node& root) {
  return std::any_of(root.entries.begin(), root.entries.end(), [](const auto& entry) {
    return nearest(entry.first->text, std::array<std::string_view, 1>{"events"}).has_value();
  });
}

/// A list of events, of which at least one has a known verb.
bool has_events(const yaml::Node& node) {
  return node.kind == yaml::Kind::sequence &&
         std::any_of(node.items.begin(), node.items.end(), [](const yaml::Node* item) {
           return has_any(*item, scripted_verb_words()) || item->find("expect") != nullptr;
         });
}

/// A list that begins with a misspelt verb.
bool has_misspelt_verb(const yaml::Node* events) {
  if (events == nullptr || events->items.empty()) return false;
  const auto& entries = events->items.front()->entries;
  return std::any_of(entries.begin(), entries.end(), [](const auto& entry) {
    return nearest(entry.first->text, scripted_verb_words()).has_value();
  });
}

/// Other YAML files may begin like a script.
bool is_script_surely(const yaml::Node& root) {
  const yaml::Node* const events = root.find("events");
  const bool names_both = root.find("catalog") != nullptr && events != nullptr;
  return names_both || has_events(root) || has_misspelt_verb(events) ||
         std::any_of(root.entries.begin(), root.entries.end(),
                     [](const auto& entry) { return has_events(*entry.second); });
}

/// Other YAML files, such as JSON schemas, have a mapping under this key.
bool has_properties(const yaml::Node& root) {
  const yaml::Node* const properties = root.find("properties");
  return properties == nullptr || properties->kind == yaml::Kind::sequence;
}

/// What a valid document is.
Recognition recognize_root(const yaml::Node& root) {
  constexpr bool is_faulty = true;
  if (is_catalog(root)) return {FileKind::catalog};
  if (is_list_of_behaviors(root)) return {FileKind::catalog, is_faulty};
  if (is_property_file(root)) return {FileKind::properties, false, has_properties(root)};
  if (is_script(root)) return {FileKind::script, false, is_script_surely(root)};
  if (has_misspelt_events(root)) return {FileKind::script, is_faulty, is_script_surely(root)};
  if (resembles_catalog(root) || find_inner_section(root)) return {FileKind::catalog, is_faulty};
  return {};
}

/// What a text was meant to be that is not valid YAML, by its words.
Recognition recognize_words(const KeyWords& words) {
  constexpr bool is_faulty = true;
  if (words.has_any(sections_of_catalogs)) return {FileKind::catalog, is_faulty};
  const bool has_verb = words.has_any(scripted_verb_words());
  if ((words.has_any(keys_of_scripts) && (has_verb || words.has_any(expectation))) ||
      (has_verb && words.has_any(expectation))) {
    return {FileKind::script, is_faulty};
  }
  const std::size_t of_properties = words.count(keys_of_properties);
  if (of_properties > 1 || (of_properties > 0 && words.has_any(kinds_of_properties))) {
    return {FileKind::properties, is_faulty};
  }
  const std::size_t common = words.count(common_sections);
  if (common == 0) return {};
  return {FileKind::catalog, is_faulty, common > 1 || words.has_any(entries_of_catalogs)};
}

/// What one of several documents in a file is, which lines of dashes separate. Empty if there are
/// none, or one of them is not valid YAML.
std::optional<Recognition> recognize_parts(std::string_view text) {
  constexpr std::string_view separator = "\n---";
  if (text.find(separator) == std::string_view::npos) return std::nullopt;
  Recognition found;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size() - 1) + 1;
    Diagnostics ignored;
    const auto document = yaml::parse(text.substr(begin, end - begin), {}, ignored);
    if (document == nullptr) return std::nullopt;
    const Recognition part = recognize_root(document->root());
    if (found.kind == FileKind::other && part.is_sure) found.kind = part.kind;
    begin = end;
  }
  found.is_faulty = found.kind != FileKind::other;
  return found;
}

/// What a text was meant to be that is not valid YAML. Files of other programs often have several
/// documents.
Recognition recognize_broken(std::string_view text) {
  const Recognition by_words = recognize_words(KeyWords(text));
  if (by_words.kind == FileKind::other) return by_words;
  return recognize_parts(text).value_or(by_words);
}

}  // namespace

Recognition recognize(std::string_view name, std::string_view text,
                      const yaml::Document* document) {
  if (is_compiled(text)) return {FileKind::compiled};
  if (std::filesystem::path(name).filename() == settings_file_name) return {FileKind::settings};
  if (is_log(text)) return {FileKind::log};
  if (document == nullptr) return recognize_broken(text);
  return recognize_root(document->root());
}

}  // namespace cbc::cli
