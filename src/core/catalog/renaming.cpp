// A name is changed at the places that the readers of the language note when they read a name
// (core/catalog/name_place.h): only these, so that a word in a comment, a title or a parameter
// stays, and so does a behavior that is called like a task; and all of these, as what the readers
// do not read has no meaning. Only the bytes of the name change, so that comments and layout stay.
//
// To search the text for the word would need a second account of where the language has names. To
// change the tree and to write it anew would lose comments and layout.

#include "core/catalog/renaming.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "core/yaml/edits.h"
#include "core/yaml/source.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::Kind;
using yaml::Node;
using yaml::Span;

/// "character 5 is U+200B", if that would not be seen, or would do something else.
std::string fault_of_characters(std::string_view name) {
  std::size_t number = 1;
  for (std::size_t offset = 0; offset < name.size(); ++number) {
    const utf8::Decoded decoded = utf8::decode(name, offset);
    offset += decoded.bytes;
    if (!decoded.valid) return concat("character ", number, " is not valid UTF-8");
    if (!is_control(decoded.character)) continue;
    return concat("character ", number, " is no printable one");
  }
  return {};
}

/// What the text of a document with one entry in brackets and one key is read as.
bool is_read_as(const std::string& spelled, std::string_view name) {
  const std::string texts[] = {concat("[", spelled, ", {", spelled, ": ", spelled, "}]"),
                               concat("- ", spelled, "\n- ", spelled, ": ", spelled, "\n")};
  return std::all_of(std::begin(texts), std::end(texts), [name](const std::string& text) {
    Diagnostics ignored;
    const auto document = yaml::parse(text, {}, ignored);
    if (document == nullptr || document->root().items.size() != 2) return false;
    const Node& item = *document->root().items[0];
    const auto& entries = document->root().items[1]->entries;
    const auto is_name = [name](const Node& node) {
      return node.kind == Kind::scalar && node.text == name;
    };
    return is_name(item) && entries.size() == 1 && is_name(*entries[0].first) &&
           is_name(*entries[0].second);
  });
}

/// Whether a name without quotes is that name wherever names stand, and nobody takes it for a
/// boolean or a number.
bool may_be_plain(std::string_view name) {
  Node node;
  node.kind = Kind::scalar;
  node.plain = true;
  node.text = name;
  const bool is_number = name.find_first_not_of("0123456789.+-_eE") == std::string_view::npos;
  return !is_number && !yaml::to_boolean(node) && is_read_as(std::string(name), name);
}

/// Whether a name stands between such quotes as it is.
bool may_be_between(char quote, std::string_view name) {
  return name.find(quote) == std::string_view::npos &&
         (quote == '\'' || name.find('\\') == std::string_view::npos);
}

class Renamer {
 public:
  Renamer(std::string_view text, const yaml::Document& document, const Renaming& renaming)
      : text_(text), positions_(text), renaming_(renaming), spelled_(spell(renaming.new_name)) {
    for (const Node& node : document.nodes()) {
      if (node.kind == Kind::scalar) scalars_.emplace(node.range.begin, &node);
    }
    count_meanings(document.root());
  }

  RenamedText run(const std::vector<NamePlace>& names) {
    std::map<const Node*, std::size_t> uses;
    for (const NamePlace& place : names) {
      const auto found = scalars_.find(place.range.begin);
      if (found == scalars_.end() || found->second->text != renaming_.old_name) continue;
      if (place.kind == renaming_.kind) ++uses[found->second];
    }
    std::map<std::size_t, yaml::TextEdit> edits;  // by their begin
    for (const auto& [node, count] : uses) {
      if (count < meanings_[node]) {
        return refuse(*node, "aliases give it another meaning, too; write the name out there");
      }
      const yaml::TextEdit edit = edit_of(*node);
      if (edit.span.begin >= edit.span.end) {
        return refuse(*node, "it goes over several lines; write it on one");
      }
      edits.emplace(edit.span.begin, edit);
    }
    std::vector<yaml::TextEdit> in_order;
    in_order.reserve(edits.size());
    for (const auto& [begin, edit] : edits) in_order.push_back(edit);
    return {yaml::apply_edits(text_, in_order), in_order.size(), std::nullopt};
  }

 private:
  RenamedText refuse(const Node& node, std::string_view why) const {
    return {
        {},
        0,
        RenamedText::Obstacle{node.range, concat(quote(renaming_.old_name),
                                                 " cannot be changed here: ", std::string(why))}};
  }

  /// How often the tree has each scalar. Values of keys such as "x-arm" have no meaning.
  void count_meanings(const Node& node) {
    if (node.kind == Kind::scalar) ++meanings_[&node];
    for (const Node* item : node.items) count_meanings(*item);
    for (const auto& [key, value] : node.entries) {
      count_meanings(*key);
      if (!key->text.starts_with("x-")) count_meanings(*value);
    }
  }

  /// Nothing is replaced if it is not certain where the name ends.
  [[nodiscard]] yaml::TextEdit edit_of(const Node& node) const {
    const Span span{positions_.offset(node.range.begin), positions_.offset(node.range.end)};
    const std::string_view found = text_.substr(span.begin, span.end - span.begin);
    if (found == renaming_.old_name) return {span, spelled_};
    if (found.size() < 2 || found.front() != found.back()) return {};
    const char quote = found.front();
    if (quote != '"' && quote != '\'') return {};
    const bool is_verbatim = found.substr(1, found.size() - 2) == renaming_.old_name;
    if (is_verbatim && may_be_between(quote, renaming_.new_name)) {
      return {{span.begin + 1, span.end - 1}, renaming_.new_name};
    }
    return {span, spelled_};
  }

  std::string_view text_;  // without a byte order mark, as places are counted
  const PositionMap positions_;
  const Renaming& renaming_;
  const std::string spelled_;
  std::map<Position, const Node*> scalars_;
  std::unordered_map<const Node*, std::size_t> meanings_;
};

}  // namespace

std::optional<Range> place_of_name(const Catalog& catalog, NameKind kind, std::string_view name) {
  return visit_named(catalog, kind, [name](const auto& things) -> std::optional<Range> {
    for (const auto& thing : things) {
      if (thing.name == name) return thing.range;
    }
    return std::nullopt;
  });
}

std::string spell(std::string_view name) {
  return may_be_plain(name) ? std::string(name) : yaml::in_quotes(name);
}

std::string fault_of_new_name(const Renaming& renaming) {
  const std::string& name = renaming.new_name;
  if (name.empty()) return "a name must not be empty";
  if (name == renaming.old_name) return concat(quote(name), " is the old name");
  if (std::string fault = fault_of_characters(name); !fault.empty()) {
    return concat(quote(name), " is no name: ", fault);
  }
  if (name.front() == ' ' || name.back() == ' ') {
    return concat(quote(name), " is no name: a blank at its begin or end is not seen");
  }
  if (renaming.kind == NameKind::behavior && name == "any") {
    return "'any' is no name of a behavior: where one is expected to run, it stands for any of "
           "them";
  }
  return {};
}

RenamedText rename_in(std::string_view text, const yaml::Document& document,
                      const std::vector<NamePlace>& names, const Renaming& renaming) {
  const std::string_view body = utf8::without_byte_order_mark(text);
  RenamedText renamed = Renamer(body, document, renaming).run(names);
  renamed.text.insert(0, text.substr(0, text.size() - body.size()));
  return renamed;
}

bool differ_only_in_name(const NamedText& before, const NamedText& after,
                         const Renaming& renaming) {
  const auto same_kind = [](const NamePlace& a, const NamePlace& b) { return a.kind == b.kind; };
  if (!std::equal(before.names.begin(), before.names.end(), after.names.begin(), after.names.end(),
                  same_kind)) {
    return false;
  }
  std::set<Position> places;
  for (const NamePlace& place : before.names) {
    if (place.kind == renaming.kind) places.insert(place.range.begin);
  }
  const auto text_after = [&](const Node& node) -> const std::string& {
    const bool is_renamed = node.text == renaming.old_name && places.contains(node.range.begin);
    return is_renamed ? renaming.new_name : node.text;
  };
  const auto& old_nodes = before.document.nodes();
  const auto& new_nodes = after.document.nodes();
  return std::equal(old_nodes.begin(), old_nodes.end(), new_nodes.begin(), new_nodes.end(),
                    [&](const Node& a, const Node& b) {
                      return a.kind == b.kind && a.items.size() == b.items.size() &&
                             a.entries.size() == b.entries.size() && text_after(a) == b.text;
                    });
}

Catalog with_new_name(Catalog catalog, const Renaming& renaming) {
  visit_named(catalog, renaming.kind, [&renaming](auto& things) {
    for (auto& thing : things) {
      if (thing.name == renaming.old_name) thing.name = renaming.new_name;
    }
  });
  return catalog;
}

}  // namespace cbc
