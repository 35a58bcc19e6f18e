#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/support/wording.h"
#include "core/yaml/source.h"
#include "lsp/features/features.h"

namespace cbc::lsp {
namespace {

// SymbolKind of the protocol.
constexpr int symbol_class = 5;
constexpr int symbol_function = 12;
constexpr int symbol_variable = 13;
constexpr int symbol_array = 18;
constexpr int symbol_event = 24;

int symbol_kind(std::string_view key) {
  if (key == "tasks" || key == "task") return symbol_class;
  if (key == "behaviors" || key == "behavior") return symbol_function;
  if (key == "situation" || key == "variable") return symbol_variable;
  if (key == "events") return symbol_event;
  return symbol_array;
}

/// Nodes deeper than this in an entry are not looked at for where it ends.
constexpr std::size_t most_depth = 64;

/// Where the last scalar of a node ends. An alias may stand before its place.
Position end_of(const yaml::Node& node, std::size_t depth = 0) {
  Position end = node.range.end;
  if (depth == most_depth || node.shared) return end;
  for (const yaml::Node* const item : node.items) end = std::max(end, end_of(*item, depth + 1));
  for (const auto& [key, value] : node.entries) {
    end = std::max({end, key->range.end, end_of(*value, depth + 1)});
  }
  return end;
}

std::string text_of(const yaml::Node& node) {
  if (node.kind == yaml::Kind::scalar) return node.text;
  std::vector<std::string> texts;
  for (const yaml::Node* const item : node.items) texts.push_back(text_of(*item));
  return node.items.empty() ? std::string() : "[" + join(texts, ", ") + "]";
}

/// What an entry of a list is called: its name, or else its first key and value.
std::string title_of(const yaml::Node& item) {
  if (item.entries.empty()) return text_of(item);
  for (const std::string_view key : {"name", "behavior", "task", "variable"}) {
    const yaml::Node* const value = item.find(key);
    if (value != nullptr && !value->text.empty()) return value->text;
  }
  const auto& [key, value] = item.entries.front();
  const std::string text = text_of(*value);
  return text.empty() ? key->text : key->text + ": " + text;
}

class SymbolList {
 public:
  explicit SymbolList(const File& file) : text_(*file.text) {
    for (const auto& [key, value] : file.input->document->root().entries) {
      Json children = Json::array();
      for (const yaml::Node* const item : value->items) {
        children.push_back(symbol(title_of(*item), symbol_kind(key->text), *item, end_of(*item)));
      }
      Json section =
          symbol(key->text, symbol_kind(key->text), *key, std::max(key->range.end, end_of(*value)));
      if (!children.empty()) section["children"] = std::move(children);
      symbols_.push_back(std::move(section));
    }
    // A script may be a list of its events.
    for (const yaml::Node* const item : file.input->document->root().items) {
      symbols_.push_back(symbol(title_of(*item), symbol_event, *item, end_of(*item)));
    }
  }

  [[nodiscard]] Json release() { return std::move(symbols_); }

 private:
  [[nodiscard]] Json symbol(const std::string& name, int kind, const yaml::Node& at,
                            const Position& end) const {
    return {{"name", name.empty() ? std::string("(no name)") : name},
            {"kind", kind},
            {"range", to_json(text_.range_of({at.range.begin, end}))},
            {"selectionRange", to_json(text_.range_of(at.range))}};
  }

  const Text& text_;
  Json symbols_ = Json::array();
};

}  // namespace

namespace {

/// Without a tree, each says where it stands.
void flatten(const Json& symbols, const std::string& container, const std::string& uri,
             Json& flat) {
  for (const Json& symbol : symbols) {
    flat.push_back({{"name", symbol.at("name")},
                    {"kind", symbol.at("kind")},
                    {"location", {{"uri", uri}, {"range", symbol.at("range")}}}});
    if (!container.empty()) flat.back()["containerName"] = container;
    if (symbol.contains("children")) flatten(symbol.at("children"), symbol.at("name"), uri, flat);
  }
}

}  // namespace

Json list_symbols(const File& file, const Client& client) {
  if (file.input == nullptr || file.input->document == nullptr) return Json::array();
  if (file.kind == cli::FileKind::other) return Json::array();
  Json symbols = SymbolList(file).release();
  if (client.has_symbol_trees) return symbols;
  Json flat = Json::array();
  flatten(symbols, "", file.uri, flat);
  return flat;
}

/// By indentation, so that it does not matter whether the text parses.
Json list_folds(const File& file) {
  Json folds = Json::array();
  if (file.text == nullptr) return folds;
  const std::string_view text = file.text->content();
  struct Open {
    std::size_t indentation = 0;
    std::uint32_t line = 0;
  };
  std::vector<Open> open;
  std::uint32_t line = 0;
  std::uint32_t last = 0;  // with content
  const auto close = [&](std::size_t indentation) {
    while (!open.empty() && open.back().indentation >= indentation) {
      if (last > open.back().line) {
        folds.push_back({{"startLine", open.back().line}, {"endLine", last}});
      }
      open.pop_back();
    }
  };
  for (std::size_t at = 0; at < text.size(); ++line) {
    const std::size_t end = yaml::end_of_line(text, at);
    const std::size_t content = std::min(text.find_first_not_of(" \t\r", at), text.size());
    if (content < end) {
      // A list may stand below its key with the same indentation.
      const bool is_item = text[content] == '-' && content + 1 < end && text[content + 1] == ' ';
      const std::size_t indentation = 2 * (content - at) + (is_item ? 1 : 0);
      close(indentation);
      open.push_back({indentation, line});
      last = line;
    }
    at = end + 1;
  }
  close(0);
  return folds;
}

}  // namespace cbc::lsp
