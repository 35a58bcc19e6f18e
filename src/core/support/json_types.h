#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "cbc/units.h"
#include "core/support/json.h"
#include "runtime/base/id.h"

// The types of JSON values, for descriptions (see json_description.h).
//
// Each type has up to three functions. `write` writes a value where one is expected: after a key,
// or as an item. `put_schema` adds keywords to the open object of a schema. `read` reads a
// yaml::JsonValue. Some have a function `has`: whether the value is one that is there.

namespace cbc::json {

/// The definitions of a schema, by name, in the order in which they are complete.
class Definitions {
 public:
  /// `put` writes the members of the definition.
  template <typename Put>
  void add(std::string_view name, Put put) {
    std::string text;
    JsonWriter json(text);
    json.open('{');
    put(json);
    json.close('}');
    add_text(name, text);
  }
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& texts() const {
    return texts_;
  }

 private:
  /// Throws if there is another definition of this name.
  void add_text(std::string_view name, const std::string& definition);

  std::vector<std::pair<std::string, std::string>> texts_;
};

/// What a projection makes of an object.
template <typename Projection, typename Object, typename Context>
decltype(auto) project(const Projection& projection, Object& object, const Context& context) {
  if constexpr (std::is_invocable_v<const Projection&, Object&, const Context&>) {
    return std::invoke(projection, object, context);
  } else {
    return std::invoke(projection, object);
  }
}

/// Hands each item to `take`. The items are a range, or a function that takes `take`.
template <typename Items, typename Take>
void for_each(const Items& items, const Take& take) {
  if constexpr (requires { items.begin(); }) {
    for (const auto& item : items) take(item);
  } else {
    items(take);
  }
}

// Plain values.

struct Boolean {
  void write(JsonWriter& json, std::same_as<bool> auto value, const auto& /*context*/) const {
    json.put(value);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write("type", "boolean");
  }
  void read(const auto& json, bool& value, const auto& /*context*/) const { value = json.truth(); }
};
inline constexpr Boolean boolean;

/// Always the same value. Members of this type are there only if it is the value.
template <typename Value>
struct Constant {
  Value constant;

  [[nodiscard]] bool has(const Value& value) const { return value == constant; }
  void write(JsonWriter& json, const auto& /*value*/, const auto& /*context*/) const {
    json.put(constant);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write("const", constant);
  }
  void read(const auto& json, bool& value, const auto& /*context*/) const { value = json.truth(); }
};
inline constexpr Constant<bool> always_true{true};
inline constexpr Constant<bool> always_false{false};

struct Null {
  void write(JsonWriter& json, const auto& /*value*/, const auto& /*context*/) const {
    json.put(nullptr);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write("type", "null");
  }
};
inline constexpr Null null;

struct Integer {
  static constexpr std::int64_t any = std::numeric_limits<std::int64_t>::max();

  std::int64_t least = 0;
  std::int64_t most = any;

  template <std::integral Number>
  void write(JsonWriter& json, Number value, const auto& /*context*/) const {
    static_assert(!std::same_as<Number, bool>);
    json.put(value);
  }
  template <typename Kind>
  void write(JsonWriter& json, Id<Kind> id, const auto& /*context*/) const {
    json.put(std::uint32_t{id});
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write_members({{"type", "integer"}, {"minimum", least}});
    if (most != any) json.write("maximum", most);
  }
  template <std::integral Number>
  void read(const auto& json, Number& value, const auto& /*context*/) const {
    const Number limit = std::numeric_limits<Number>::max();
    value = json.template integer<Number>(
        static_cast<Number>(least),
        most == any || std::cmp_greater(most, limit) ? limit : static_cast<Number>(most));
  }
};
[[nodiscard]] constexpr Integer integer(std::int64_t least, std::int64_t most = Integer::any) {
  return {least, most};
}
inline constexpr Integer count;
inline constexpr Integer line_number{1};
inline constexpr Integer priority{0, std::numeric_limits<std::int32_t>::max()};

/// A number that is not negative; numbers of other units are written by PutNumber.
template <typename PutNumber>
struct Number {
  std::optional<double> most;
  bool is_positive = false;  ///< not 0
  PutNumber put;

  void write(JsonWriter& json, const auto& value, const auto& /*context*/) const {
    put(json, value);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write("type", "number");
    json.write(is_positive ? "exclusiveMinimum" : "minimum", 0);
    if (most) json.write("maximum", static_cast<std::int64_t>(*most));
  }
};
struct PutDouble {
  void operator()(JsonWriter& json, std::floating_point auto value) const { json.put(value); }
};
struct PutSeconds {
  void operator()(JsonWriter& json, Microseconds time) const { json.put_seconds(time); }
};
struct PutPercent {
  void operator()(JsonWriter& json, Millionths degree) const { json.put_percent(degree); }
};
inline constexpr Number<PutDouble> number{};
inline constexpr Number<PutDouble> share{1, false, {}};
/// Of a double; of millionths as a whole number where it is one.
inline constexpr Number<PutDouble> percentage{100, false, {}};
inline constexpr Number<PutPercent> percent{100, false, {}};
inline constexpr Number<PutPercent> positive_percent{100, true, {}};
/// Of microseconds.
inline constexpr Number<PutSeconds> seconds{};
inline constexpr Number<PutSeconds> positive_seconds{std::nullopt, true, {}};

struct Text {
  bool may_be_empty = false;
  std::string_view pattern = {};

  void write(JsonWriter& json, std::string_view value, const auto& /*context*/) const {
    json.put(value);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write("type", "string");
    if (!pattern.empty()) {
      json.write("pattern", pattern);
    } else if (!may_be_empty) {
      json.write("minLength", 1);
    }
  }
  void read(const auto& json, std::string& value, const auto& /*context*/) const {
    value = json.text();
  }
  /// As the name of a member.
  [[nodiscard]] std::string_view text(std::string_view key, const auto& /*context*/) const {
    return key;
  }
};
inline constexpr Text text;  ///< not empty
inline constexpr Text any_text{true};
[[nodiscard]] constexpr Text matching(std::string_view pattern) { return {true, pattern}; }
inline constexpr Text digest = matching("^[0-9a-f]{32}$");
/// A whole number that may exceed any number format.
inline constexpr Text large_number = matching("^(0|[1-9][0-9]*)$");
inline constexpr Text version_number = matching("^[0-9]+\\.[0-9]+\\.[0-9]+$");

/// The words for the values of an enumeration, from 0 to the last one; name_of() has them.
template <typename Enum>
struct Words {
  Enum last;

  void write(JsonWriter& json, Enum value, const auto& /*context*/) const {
    json.put(std::string_view(name_of(value)));
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.open("enum", '[');
    for (int value = 0; value <= static_cast<int>(last); ++value) {
      json.write(std::string_view(name_of(static_cast<Enum>(value))));
    }
    json.close(']');
  }
  void read(const auto& json, Enum& value, const auto& /*context*/) const {
    const std::string word = json.text();
    for (int known = 0; known <= static_cast<int>(last); ++known) {
      value = static_cast<Enum>(known);
      if (std::string_view(name_of(value)) == word) return;
    }
    json.refuse_word(word);
  }
};
template <typename Enum>
[[nodiscard]] constexpr Words<Enum> words(Enum last) {
  return {last};
}

/// Some of the words.
template <typename Enum, std::size_t size>
struct SomeWords {
  std::array<Enum, size> values;

  void write(JsonWriter& json, Enum value, const auto& /*context*/) const {
    json.put(std::string_view(name_of(value)));
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.open("enum", '[');
    for (const Enum value : values) json.write(std::string_view(name_of(value)));
    json.close(']');
  }
};
template <typename Enum, std::size_t size>
[[nodiscard]] constexpr SomeWords<Enum, size> words_among(const Enum (&values)[size]) {
  return {std::to_array(values)};
}

/// Words by their places in a list: the second one for 1, or true.
template <std::size_t size>
struct WordList {
  std::array<std::string_view, size> list;

  void write(JsonWriter& json, std::integral auto place, const auto& /*context*/) const {
    json.put(list.at(static_cast<std::size_t>(place)));
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write_list("enum", list);
  }
};

/// An object of any form, given as JSON.
struct FreeObject {
  void write(JsonWriter& json, std::string_view form, const auto& /*context*/) const {
    json.put_json(form);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write("type", "object");
  }
};
inline constexpr FreeObject free_object;

// What consists of others.

/// Null if there is no value: an empty optional, a null pointer, or what the type says is none.
template <typename Type>
struct Nullable {
  Type type;

  void write(JsonWriter& json, const auto& value, const auto& context) const {
    if constexpr (requires { type.has(value); }) {
      if (type.has(value)) return type.write(json, value, context);
    } else {
      if (value) return type.write(json, *value, context);
    }
    json.put(nullptr);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    json.open("anyOf", '[');
    json.open('{');
    type.put_schema(json, definitions);
    json.close('}');
    json.write_object({{"type", "null"}});
    json.close(']');
  }
  template <typename Value>
  void read(const auto& json, std::optional<Value>& value, const auto& context) const {
    value.reset();
    if (!json.is_null()) type.read(json, value.emplace(), context);
  }
};
template <typename Type>
[[nodiscard]] constexpr Nullable<Type> nullable(Type type) {
  return {type};
}

/// A type with a definition of its own in the schema.
template <typename Type>
struct Named {
  std::string_view name;
  std::string_view meaning;
  Type type;

  void write(JsonWriter& json, const auto& value, const auto& context) const {
    type.write(json, value, context);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    definitions.add(name, [&](JsonWriter& part) {
      if (!meaning.empty()) part.write("description", meaning);
      type.put_schema(part, definitions);
    });
    json.write("$ref", "#/$defs/" + std::string(name));
  }
  void read(const auto& json, auto& value, const auto& context) const {
    type.read(json, value, context);
  }
};
template <typename Type>
[[nodiscard]] constexpr Named<Type> named(std::string_view name, std::string_view meaning,
                                          Type type) {
  return {name, meaning, type};
}

template <typename Item>
struct List {
  Item item;
  std::size_t least = 0;
  std::size_t most = 0;    ///< 0: any number
  bool is_set = false;     ///< no item occurs twice
  bool has_lines = false;  ///< each item is written on a line of its own

  [[nodiscard]] constexpr List at_least(std::size_t size) const {
    return {item, size, most, is_set, has_lines};
  }
  [[nodiscard]] constexpr List exactly(std::size_t size) const {
    return {item, size, size, is_set, has_lines};
  }
  [[nodiscard]] constexpr List unique() const { return {item, least, most, true, has_lines}; }
  [[nodiscard]] constexpr List on_lines() const { return {item, least, most, is_set, true}; }

  /// Values are a range, or a function that takes a function, which it calls with each item.
  void write(JsonWriter& json, const auto& values, const auto& context) const {
    json.begin('[');
    for_each(values, [&](const auto& value) {
      if (has_lines) json.on_new_line();
      json.begin_item();
      item.write(json, value, context);
    });
    json.close(']');
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    json.write("type", "array");
    json.open("items", '{');
    item.put_schema(json, definitions);
    json.close('}');
    if (least > 0) json.write("minItems", least);
    if (most > 0) json.write("maxItems", most);
    if (is_set) json.write("uniqueItems", true);
  }
  template <typename Value>
  void read(const auto& json, std::vector<Value>& values, const auto& context) const {
    for (const auto& part : json.items()) item.read(part, values.emplace_back(), context);
  }
};
template <typename Item>
[[nodiscard]] constexpr List<Item> list(Item item) {
  return {item};
}
inline constexpr auto texts = list(text);
inline constexpr auto names = list(text).unique();
inline constexpr auto lines = list(line_number).at_least(1).unique();

/// An object whose members have names that vary.
template <typename Key, typename Type>
struct Map {
  Key key;
  Type type;
  bool may_be_empty = true;

  [[nodiscard]] constexpr Map not_empty() const { return {key, type, false}; }

  /// Values are a range of pairs, or a function as for a List, which has two arguments.
  void write(JsonWriter& json, const auto& values, const auto& context) const {
    const auto put = [&](const auto& name, const auto& value) {
      json.key(key.text(name, context));
      type.write(json, value, context);
    };
    json.begin('{');
    if constexpr (requires { values.begin(); }) {
      for (const auto& [name, value] : values) put(name, value);
    } else {
      values(put);
    }
    json.close('}');
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    json.write("type", "object");
    if (!may_be_empty) json.write("minProperties", 1);
    json.open("additionalProperties", '{');
    type.put_schema(json, definitions);
    json.close('}');
  }
  template <typename Name, typename Value>
  void read(const auto& json, std::vector<std::pair<Name, Value>>& values,
            const auto& context) const {
    for (const auto& part : json.members()) {
      std::pair<Name, Value> value;
      key.read_name(part, value.first, context);
      type.read(part, value.second, context);
      values.push_back(std::move(value));
    }
  }
};
template <typename Key, typename Type>
[[nodiscard]] constexpr Map<Key, Type> map(Key key, Type type) {
  return {key, type};
}

template <typename Type, typename Projection>
struct Item {
  Type type;
  Projection projection;
};
template <typename Type, typename Projection>
[[nodiscard]] constexpr Item<Type, Projection> item(Type type, Projection projection) {
  return {type, projection};
}

/// An array with an item for each thing that there is to say.
template <typename... Items>
struct Row {
  std::tuple<Items...> items;

  template <typename Object>
  void write(JsonWriter& json, const Object& object, const auto& context) const {
    const auto put = [&](const auto& item) {
      json.begin_item();
      item.type.write(json, project(item.projection, object, context), context);
    };
    json.begin('[');
    std::apply([&](const auto&... item) { (put(item), ...); }, items);
    json.close(']');
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    const auto put = [&](const auto& item) {
      json.open('{');
      item.type.put_schema(json, definitions);
      json.close('}');
    };
    json.write("type", "array");
    json.open("prefixItems", '[');
    std::apply([&](const auto&... item) { (put(item), ...); }, items);
    json.close(']');
    json.write("minItems", sizeof...(Items));
    json.write("items", false);
  }
};
template <typename... Items>
[[nodiscard]] constexpr Row<Items...> row(Items... items) {
  return {{items...}};
}

/// Objects of which some are ruled out where they are used. `properties` is JSON.
template <typename Type>
struct Restricted {
  Type type;
  std::string_view properties;

  void write(JsonWriter& json, const auto& value, const auto& context) const {
    type.write(json, value, context);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    type.put_schema(json, definitions);
    json.write("type", "object");
    json.write_json("properties", properties);
  }
};
template <typename Type>
[[nodiscard]] constexpr Restricted<Type> restricted(Type type, std::string_view properties) {
  return {type, properties};
}

/// What a projection makes of a value.
template <typename Projection, typename Type>
struct Projected {
  Projection projection;
  Type type;

  void write(JsonWriter& json, const auto& value, const auto& context) const {
    type.write(json, project(projection, value, context), context);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    type.put_schema(json, definitions);
  }
};
template <typename Projection, typename Type>
[[nodiscard]] constexpr Projected<Projection, Type> projected(Projection projection, Type type) {
  return {projection, type};
}

/// What a pointer points to.
template <typename Type>
[[nodiscard]] constexpr auto pointed(Type type) {
  return projected(
      [](const auto* value) -> const auto& { return *value; }, type);
}

/// A part with a context of its own.
template <typename Projection, typename Type>
struct Scoped {
  Projection context_of;
  Type type;

  void write(JsonWriter& json, const auto& value, const auto& context) const {
    type.write(json, value, project(context_of, value, context));
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    type.put_schema(json, definitions);
  }
};
template <typename Projection, typename Type>
[[nodiscard]] constexpr Scoped<Projection, Type> scoped(Projection context_of, Type type) {
  return {context_of, type};
}

/// One of several types, in a schema.
template <typename... Types>
struct Choice {
  std::string_view meaning;
  std::tuple<Types...> types;

  void put_schema(JsonWriter& json, Definitions& definitions) const {
    const auto put = [&](const auto& type) {
      json.open('{');
      type.put_schema(json, definitions);
      json.close('}');
    };
    if (!meaning.empty()) json.write("description", meaning);
    json.open("oneOf", '[');
    std::apply([&](const auto&... type) { (put(type), ...); }, types);
    json.close(']');
  }
};
template <typename... Types>
[[nodiscard]] constexpr Choice<Types...> choice(std::string_view meaning, Types... types) {
  return {meaning, {types...}};
}

}  // namespace cbc::json
