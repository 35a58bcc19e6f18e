#include "fuzz/tree.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include <fmt/core.h>

#include "core/diagnostic/diagnostic.h"
#include "runtime/base/text.h"

namespace cbc::fuzz {
namespace {

using oracle::Random;
using yaml::Kind;

/// Aliases may make many nodes of a few.
constexpr std::size_t most_tree_nodes = 5000;
/// Deeper trees than this are refused anyway.
constexpr std::size_t greatest_depth = yaml::maximum_depth + 2;
constexpr std::size_t longest_scalar = 64;

bool copy(const yaml::Node& node, Tree& tree, std::size_t& left) {
  if (left == 0) return false;
  --left;
  tree.kind = node.kind;
  tree.plain = node.plain;
  tree.text = node.text;
  const auto add = [&](const yaml::Node& child) {
    return copy(child, tree.items.emplace_back(), left);
  };
  for (const yaml::Node* const item : node.items) {
    if (!add(*item)) return false;
  }
  for (const auto& entry : node.entries) {
    if (!add(*entry.first) || !add(*entry.second)) return false;
  }
  return true;
}

/// Whether the text is a scalar that stays the same without quotes.
bool is_safe_plain(std::string_view text, Language language) {
  if (language != Language::yaml) {
    if (text == "true" || text == "false" || text == "null") return true;
    yaml::JsonReader reader;
    const yaml::Node* const node = reader.read(text);
    return node != nullptr && node->kind == Kind::scalar && node->plain;
  }
  const auto is_harmless = [](char byte) {
    return std::isalnum(static_cast<unsigned char>(byte)) != 0 || byte == '_' || byte == '.' ||
           byte == '+' || byte == '/' || byte == '-';
  };
  return !text.empty() && text.front() != '-' && std::all_of(text.begin(), text.end(), is_harmless);
}

void write_quoted(std::string_view text, std::string& out) {
  out += '"';
  for (std::size_t at = 0; at < text.size();) {
    const utf8::Decoded decoded = utf8::decode(text, at);
    const char byte = text[at];
    if (byte == '"' || byte == '\\') {
      out += '\\';
      out += byte;
    } else if (static_cast<unsigned char>(byte) < 0x20 || byte == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(byte));
    } else if (decoded.valid) {
      out += text.substr(at, decoded.bytes);
    } else {
      out += '?';
    }
    at += decoded.bytes;
  }
  out += '"';
}

class Writer {
 public:
  explicit Writer(Language language) : language_(language) {}

  std::string write(const Tree& tree) {
    if (language_ == Language::yaml && !tree.items.empty()) {
      write_block(tree);
    } else {
      write_flow(tree);
      out_ += '\n';
    }
    return std::move(out_);
  }

 private:
  /// A mapping whose values are lists, a line for each entry; anything else on one line.
  void write_block(const Tree& tree) {
    if (tree.kind == Kind::sequence) {
      write_entries(tree);
      return;
    }
    for (std::size_t place = 0; place + 1 < tree.items.size(); place += 2) {
      write_flow(tree.items[place]);
      out_ += ':';
      const Tree& value = tree.items[place + 1];
      if (value.kind == Kind::sequence && !value.items.empty()) {
        out_ += '\n';
        write_entries(value);
      } else {
        out_ += ' ';
        write_flow(value);
        out_ += '\n';
      }
    }
  }

  void write_entries(const Tree& list) {
    for (const Tree& item : list.items) {
      out_ += "- ";
      write_flow(item);
      out_ += '\n';
    }
  }

  void write_flow(const Tree& tree) {
    switch (tree.kind) {
      case Kind::null:
        out_ += "null";
        break;
      case Kind::scalar:
        if (tree.plain && is_safe_plain(tree.text, language_)) {
          out_ += tree.text;
        } else {
          write_quoted(tree.text, out_);
        }
        break;
      case Kind::sequence:
        write_items(tree, '[', ']');
        break;
      case Kind::mapping:
        write_items(tree, '{', '}');
        break;
    }
  }

  void write_items(const Tree& tree, char begin, char end) {
    const bool is_mapping = tree.kind == Kind::mapping;
    out_ += begin;
    for (std::size_t place = 0; place < tree.items.size(); ++place) {
      const bool is_value = is_mapping && place % 2 == 1;
      if (place > 0) out_ += is_value ? ": " : ", ";
      const bool is_name = is_mapping && !is_value && language_ != Language::yaml;
      if (is_name) {
        write_quoted(tree.items[place].text, out_);
      } else {
        write_flow(tree.items[place]);
      }
    }
    out_ += end;
  }

  Language language_;
  std::string out_;
};

void collect(Tree& tree, std::vector<Tree*>& all) {
  all.push_back(&tree);
  for (Tree& item : tree.items) collect(item, all);
}

std::size_t depth_of(const Tree& tree) {
  std::size_t depth = 0;
  for (const Tree& item : tree.items) depth = std::max(depth, depth_of(item));
  return depth + 1;
}

std::size_t step_of(const Tree& tree) { return tree.kind == Kind::mapping ? 2 : 1; }

/// Removes, repeats or moves an item of a collection.
void change_items(Tree& tree, Random& random) {
  const std::size_t step = step_of(tree);
  const std::size_t count = tree.items.size() / step;
  if (count == 0) return;
  const auto place_of = [&](std::size_t item) {
    return tree.items.begin() + static_cast<std::ptrdiff_t>(item * step);
  };
  const std::size_t item = random.below(count);
  const std::size_t other = random.below(count);
  const auto after = [step](auto place) { return place + static_cast<std::ptrdiff_t>(step); };
  switch (random.below(3)) {
    case 0:
      tree.items.erase(place_of(item), after(place_of(item)));
      break;
    case 1: {
      const std::vector<Tree> copies(place_of(item), after(place_of(item)));
      tree.items.insert(place_of(other), copies.begin(), copies.end());
      break;
    }
    default:
      if (item != other) {
        std::swap_ranges(place_of(item), after(place_of(item)), place_of(other));
      }
  }
}

/// Adds an item of another collection of the same kind, or a new one.
void add_item(Tree& tree, const std::vector<Tree*>& all, Random& random,
              const std::vector<std::string>& words) {
  std::vector<Tree> added;
  const Tree& other = *random.pick(all);
  if (other.kind == tree.kind && &other != &tree && !other.items.empty()) {
    const std::size_t step = step_of(other);
    const std::size_t begin = random.below(other.items.size() / step) * step;
    for (std::size_t i = 0; i < step; ++i) added.push_back(other.items[begin + i]);
  } else {
    if (tree.kind == Kind::mapping) added.push_back({Kind::scalar, true, random.pick(words), {}});
    added.push_back(other);
  }
  tree.items.insert(tree.items.end(), std::make_move_iterator(added.begin()),
                    std::make_move_iterator(added.end()));
}

std::string number_near(const std::string& text, Random& random) {
  static const std::vector<std::string> edges = {
      "0",          "1",          "-1",         "100",  "101",
      "0.5",        "99.999999",  "1e6",        "1e-7", "65536",
      "2147483647", "2147483648", "4294967296", ".5",   "1000000000000000000",
      "inf",        "nan",        "0x10",       "007"};
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || random.percent(40)) return random.pick(edges);
  const std::vector<double> factors = {1, 10, 0.1, -1};
  return fmt::format("{}",
                     value * random.pick(factors) + static_cast<double>(random.between(-1, 1)));
}

void change_scalar(Tree& tree, Random& random, const std::vector<std::string>& words,
                   MutateBytes mutate_bytes) {
  tree.items.clear();
  tree.kind = Kind::scalar;
  switch (random.below(5)) {
    case 0:
    case 1:
      tree.text = random.pick(words);
      tree.plain = !random.percent(20);
      break;
    case 2:
    case 3:
      tree.text = number_near(tree.text, random);
      tree.plain = !random.percent(10);
      break;
    default:
      tree.text = mutate_bytes(tree.text, longest_scalar);
  }
}

}  // namespace

std::optional<Tree> read_tree(std::string_view text) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(text, "input", diagnostics);
  Tree tree;
  std::size_t left = most_tree_nodes;
  if (document == nullptr || !copy(document->root(), tree, left)) return std::nullopt;
  return tree;
}

std::string write_tree(const Tree& tree, Language language) { return Writer(language).write(tree); }

void change_tree(Tree& tree, Random& random, const std::vector<std::string>& words,
                 MutateBytes mutate_bytes) {
  std::vector<Tree*> all;
  collect(tree, all);
  Tree& chosen = *random.pick(all);
  const bool is_collection = chosen.kind == Kind::sequence || chosen.kind == Kind::mapping;
  if (is_collection && random.percent(45)) {
    change_items(chosen, random);
  } else if (is_collection && random.percent(60)) {
    add_item(chosen, all, random, words);
  } else if (random.percent(45)) {
    const Tree other = *random.pick(all);
    chosen = other;
  } else if (!is_collection || random.percent(10)) {
    change_scalar(chosen, random, words, mutate_bytes);
  }
  if (depth_of(tree) > greatest_depth) tree = Tree();
}

}  // namespace cbc::fuzz
