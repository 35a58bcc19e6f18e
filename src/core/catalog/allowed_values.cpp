#include "core/catalog/allowed_values.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "core/yaml/values.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using yaml::Kind;
using yaml::Node;

// Types --------------------------------------------------------------------------------------

enum class Item : std::uint8_t { string, boolean, integer, number, point };

struct Type {
  Item item = Item::string;
  bool is_list = false;
};

struct TypeWord {
  std::string_view name;
  Item item;
};
constexpr TypeWord type_words[] = {
    {"string", Item::string}, {"boolean", Item::boolean}, {"integer", Item::integer},
    {"number", Item::number}, {"point", Item::point},     {"text", Item::string},
    {"str", Item::string},    {"bool", Item::boolean},    {"int", Item::integer},
    {"float", Item::number},  {"double", Item::number},   {"real", Item::number}};

constexpr std::string_view list_prefix = "list_of_";
constexpr std::string_view list_suffix = "_list";

// "point", "point_list", "list_of_points", "list-of-point", "Point".
std::optional<Type> type_of(std::string_view name) {
  if (name.size() > 40) return std::nullopt;
  std::string text(name);
  std::transform(text.begin(), text.end(), text.begin(), [](char character) {
    if (character == '-' || character == ' ') return '_';
    const bool is_upper = character >= 'A' && character <= 'Z';
    return is_upper ? static_cast<char>(character - 'A' + 'a') : character;
  });
  Type type;
  if (text.starts_with(list_prefix)) {
    type.is_list = true;
    text.erase(0, list_prefix.size());
    if (text.ends_with('s')) text.pop_back();
  } else if (text.ends_with(list_suffix)) {
    type.is_list = true;
    text.erase(text.size() - list_suffix.size());
  }
  const auto* const found =
      std::find_if(std::begin(type_words), std::end(type_words),
                   [&text](const TypeWord& word) { return word.name == text; });
  if (found == std::end(type_words)) return std::nullopt;
  type.item = found->item;
  return type;
}

std::string_view describe_item(Item item) {
  constexpr std::string_view phrases[] = {"a string", "true or false", "an integer", "a number",
                                          "a point (2 or 3 numbers)"};
  return phrases[static_cast<std::size_t>(item)];
}

std::string_view describe_list(Item item) {
  constexpr std::string_view phrases[] = {"a list of strings", "a list of booleans",
                                          "a list of integers", "a list of numbers",
                                          "a list of points (2 or 3 numbers each)"};
  return phrases[static_cast<std::size_t>(item)];
}

// Values -------------------------------------------------------------------------------------

ValueFault unexpected(const Node& node, std::string_view expected) {
  return {&node, "expected " + std::string(expected) + ", found " + yaml::describe(node)};
}

std::optional<Number> number_of(const Node& node) {
  if (node.kind != Kind::scalar || !node.plain) return std::nullopt;
  return parse_number(node.text);
}

std::optional<ValueFault> check_number(const Node& node) {
  if (number_of(node)) return std::nullopt;
  return unexpected(node, describe_item(Item::number));
}

std::optional<ValueFault> check_point_list(const Node& point) {
  if (point.items.size() < 2 || point.items.size() > 3) {
    ValueFault fault = unexpected(point, describe_item(Item::point));
    if (!point.items.empty()) fault.message += " of " + std::to_string(point.items.size());
    return fault;
  }
  for (const Node* item : point.items) {
    if (auto fault = check_number(*item)) return fault;
  }
  return std::nullopt;
}

std::optional<ValueFault> check_point_mapping(const Node& point) {
  for (const std::string_view key : {"x", "y"}) {
    if (point.find(key) != nullptr) continue;
    return ValueFault{&point, "expected a point with x and y, found " + yaml::describe(point) +
                                  " without " + quote(key)};
  }
  for (const auto& [key, value] : point.entries) {
    if (key->text != "x" && key->text != "y" && key->text != "z") {
      return ValueFault{key, "expected a point with x, y and perhaps z, found " + quote(key->text)};
    }
    if (value->kind == Kind::null) continue;
    if (auto fault = check_number(*value)) return fault;
  }
  return std::nullopt;
}

std::optional<ValueFault> check_item(const Node& node, Item item) {
  bool is_good = node.kind == Kind::scalar;
  switch (item) {
    case Item::string:
      break;
    case Item::boolean:
      is_good = yaml::to_boolean(node).has_value();
      break;
    case Item::integer:
      is_good = number_of(node) && node.text.find_first_of(".eE") == std::string::npos;
      break;
    case Item::number:
      return check_number(node);
    case Item::point:
      if (node.kind == Kind::sequence) return check_point_list(node);
      if (node.kind == Kind::mapping) return check_point_mapping(node);
      is_good = false;
      break;
  }
  if (is_good) return std::nullopt;
  return unexpected(node, describe_item(item));
}

std::optional<ValueFault> check_type(const Node& node, const Type& type) {
  if (!type.is_list) return check_item(node, type.item);
  if (node.kind != Kind::sequence) return unexpected(node, describe_list(type.item));
  for (const Node* item : node.items) {
    if (auto fault = check_item(*item, type.item)) return fault;
  }
  return std::nullopt;
}

// Ranges and choices -------------------------------------------------------------------------

bool has_type_name(const Parameter& parameter) {
  return !parameter.allowed_is_list && !parameter.allowed_values.empty();
}

// A text that is equal for numbers of equal value only.
std::string value_text(const Number& number) {
  return (number.negative ? "-" : "") + number.digits + "e" + std::to_string(number.exponent);
}

// As `quote`, without the quotes.
std::string shorten_value(std::string_view text) {
  const std::string quoted = quote(text);
  return quoted.substr(1, quoted.size() - 2);
}

std::string text_of_choice(const std::vector<std::string>& values) {
  constexpr std::size_t most = 12;
  if (values.size() == 1) return shorten_value(values[0]);
  const std::span<const std::string> first(values.data(), std::min(values.size(), most));
  std::string text = "one of " + join(first, ", ", shorten_value);
  if (values.size() > most) text += " and " + std::to_string(values.size() - most) + " more";
  return text;
}

}  // namespace

std::optional<NumberRange> range_of(const Parameter& parameter) {
  if (!parameter.allowed_is_list || parameter.allowed_values.size() != 2) return std::nullopt;
  auto lowest = parse_number(parameter.allowed_values[0]);
  auto highest = parse_number(parameter.allowed_values[1]);
  if (!lowest || !highest) return std::nullopt;
  return NumberRange{std::move(*lowest), std::move(*highest)};
}

bool is_empty_range(const Parameter& parameter) {
  const auto range = range_of(parameter);
  return range && range->lowest > range->highest;
}

bool is_unknown_type(const Parameter& parameter) {
  return has_type_name(parameter) && !type_of(parameter.allowed_values[0]);
}

std::optional<std::string> nearest_type(std::string_view name) {
  std::vector<std::string> types;
  for (const TypeWord& word : type_words) {
    types.emplace_back(word.name);
    types.push_back(concat(list_prefix, word.name, "s"));
    types.push_back(concat(word.name, list_suffix));
  }
  const std::vector<std::string_view> names(types.begin(), types.end());
  const auto found = nearest(name, names);
  return found ? std::optional<std::string>(*found) : std::nullopt;
}

AllowedValues::AllowedValues(const Parameter& parameter)
    : parameter_(parameter),
      suggestions_({parameter.allowed_values.begin(), parameter.allowed_values.end()}) {
  const std::vector<std::string>& values = parameter.allowed_values;
  if (auto range = range_of(parameter)) {
    form_ = Form::range;
    lowest_ = std::move(range->lowest);
    highest_ = std::move(range->highest);
    expected_ = "a number from " + shorten_value(values[0]) + " to " + shorten_value(values[1]);
  } else if (has_type_name(parameter)) {
    if (type_of(values[0])) form_ = Form::type;
  } else if (!values.empty()) {
    form_ = Form::choice;
    expected_ = text_of_choice(values);
    for (const std::string& value : values) {
      texts_.insert(value);
      if (const auto number = parse_number(value)) numbers_.insert(value_text(*number));
    }
  }
}

std::optional<ValueFault> AllowedValues::find_fault(const Node& value) {
  if (value.kind == Kind::null) return std::nullopt;
  switch (form_) {
    case Form::anything:
      break;
    case Form::range:
      return check_range(value);
    case Form::choice:
      return check_choice(value);
    case Form::type:
      return check_type(value, *type_of(parameter_.allowed_values[0]));
  }
  return std::nullopt;
}

std::optional<ValueFault> AllowedValues::check_range(const Node& value) const {
  const std::optional<Number> number = number_of(value);
  if (number && lowest_ <= *number && *number <= highest_) return std::nullopt;
  return unexpected(value, expected_);
}

std::optional<ValueFault> AllowedValues::check_choice(const Node& value) {
  if (value.kind == Kind::scalar) {
    if (texts_.contains(value.text)) return std::nullopt;
    const std::optional<Number> number = number_of(value);
    if (number && numbers_.contains(value_text(*number))) return std::nullopt;
  }
  ValueFault fault = unexpected(value, expected_);
  fault.message += did_you_mean(suggestions_.nearest(value.text));
  return fault;
}

std::vector<Parameter> parameters_of(const CompiledCatalog& catalog, std::uint32_t task) {
  std::vector<Parameter> parameters;
  for (const CompiledParameter& from : catalog.parameters[task]) {
    Parameter& to = parameters.emplace_back();
    to.name = catalog.texts[from.name];
    to.allowed_is_list = from.allowed_is_list != 0;
    for (const TextId text :
         catalog.allowed_values.subspan(from.first_allowed, from.allowed_count)) {
      to.allowed_values.emplace_back(catalog.texts[text]);
    }
  }
  return parameters;
}

std::string spell_value(std::string_view value) {
  const bool is_clear = !value.empty() && value.find_first_of(",[]'") == std::string::npos;
  if (is_clear) return std::string(value);
  std::string text = "'";
  for (const char character : value) text += character == '\'' ? "''" : std::string(1, character);
  return text += '\'';
}

std::string describe_allowed(Parameter parameter) {
  std::vector<std::string>& values = parameter.allowed_values;
  if (values.empty()) return {};
  if (!range_of(parameter)) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  }
  const std::string text = join(values, ", ", spell_value);
  return parameter.allowed_is_list ? "[" + text + "]" : text;
}

}  // namespace cbc
