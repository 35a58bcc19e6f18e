#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/support/wording.h"
#include "core/yaml/source.h"
#include "lsp/features/features.h"
#include "lsp/language/context.h"

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

/// Of an entry, more are not looked at for what it is called.
constexpr std::size_t most_scalars = 1000;

/// The scalars of an entry of a list.
using Entry = std::vector<Context>;

/// What an entry is called, and where that stands: its name, or else its first key and value.
/// `depth`: of the list.
std::pair<std::string, const Context*> title_of(const Entry& entry, std::size_t depth) {
  for (const std::string_view key : {"name", "behavior", "task", "variable"}) {
    for (const Context& scalar : entry) {
      const bool is_value = !scalar.is_key && scalar.path.size() == depth + 1 && scalar.key == key;
      if (is_value && !scalar.text.empty()) return {scalar.text, &scalar};
    }
  }
  const Context& first = entry.front();
  const bool has_key = first.is_key && first.path.size() == depth + 1;
  std::string value;
  std::vector<std::string> list;
  for (const Context& scalar : entry) {
    const std::size_t level = scalar.path.size() - depth - (has_key ? 1 : 0);
    const bool is_in_list = scalar.is_item && level == 1;
    if (has_key ? level == 0 && scalar.key == first.text : scalar.is_item && level == 0) {
      if (value.empty()) value = scalar.text;
    } else if (is_in_list && (!has_key || scalar.path.back() == first.text)) {
      list.push_back(scalar.text);
    }
  }
  if (!list.empty()) value = "[" + join(list, ", ") + "]";
  if (!has_key) return {value, &first};
  return {value.empty() ? first.text : first.text + ": " + value, &first};
}

/// The keys of a file, and the entries of their lists; also of a text that does not parse.
class SymbolList {
 public:
  explicit SymbolList(const File& file) : text_(*file.text) {
    visit_scalars(text_.content(), [this](const Context& scalar) { take(scalar); });
    finish_entry();
  }

  [[nodiscard]] Json release() { return std::move(symbols_); }

 private:
  void take(const Context& scalar) {
    const std::vector<std::string>& path = scalar.path;
    // A script may be a list of its events.
    const bool is_list = path.empty() ? scalar.is_item : path.front().empty();
    const std::size_t depth = is_list ? 0 : 1;
    const bool is_in_entry =
        path.size() == depth ? scalar.is_item : path.size() > depth && path[depth].empty();
    if (!is_in_entry || entry_.empty() || entry_.front().entry != scalar.entry) finish_entry();
    if (path.empty() && scalar.is_key && !scalar.text.empty()) {
      symbols_.push_back(symbol(scalar.text, symbol_kind(scalar.text), scalar, scalar.begin));
      section_ = scalar.text;
    } else if (!is_list && !is_in_entry && !symbols_.empty()) {
      symbols_.back()["range"]["end"] = to_json(text_.place_of(scalar.end));
    } else if (is_in_entry) {
      if (entry_.size() < most_scalars) entry_.push_back(scalar);
      end_ = scalar.end;
      depth_ = depth;
    }
  }

  void finish_entry() {
    if (entry_.empty()) return;
    const auto [title, place] = title_of(entry_, depth_);
    const bool is_event = depth_ == 0;
    // From its bracket on, if it has one.
    const std::string& text = text_.content();
    const std::size_t content = text.find_first_not_of(" \t\r\n", entry_.front().entry);
    const bool is_comment = content < text.size() && text[content] == '#';
    Json found = symbol(title, is_event ? symbol_event : symbol_kind(section_), *place,
                        is_comment ? entry_.front().begin : content);
    found["range"]["end"] = to_json(text_.place_of(end_));
    if (is_event || symbols_.empty()) {
      symbols_.push_back(std::move(found));
    } else {
      symbols_.back()["range"]["end"] = found["range"]["end"];
      symbols_.back()["children"].push_back(std::move(found));
    }
    entry_.clear();
  }

  /// A symbol that is called by a scalar.
  [[nodiscard]] Json symbol(const std::string& name, int kind, const Context& place,
                            std::size_t begin) const {
    return {{"name", name.empty() ? std::string("(no name)") : name},
            {"kind", kind},
            {"range", range_json(text_, begin, place.end)},
            {"selectionRange", range_json(text_, place.begin, place.end)}};
  }

  const Text& text_;
  std::string section_;
  Entry entry_;
  std::size_t end_ = 0;    ///< of the entry
  std::size_t depth_ = 0;  ///< of the list of the entry
  Json symbols_ = Json::array();
};

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
  if (file.text == nullptr) return Json::array();
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
