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

// Descriptions of JSON documents. A description says once of what a document consists: the names of
// members, what they mean, and their types. From it come the writer, the reader (of documents that
// the program reads), and the JSON Schema.
//
//     constexpr auto place = object("place", "A place in a file.",
//                                   member("file", name, "The file.", &Note::file),
//                                   member("line", integer(1), "The line, from 1.", line_of));
//
// A description is a constant, which writes without a tree in memory. The last argument of a member
// is a projection: a pointer to a member, or a function that takes what is described, and if it
// wants it the context, which is handed down to all parts (a catalog, say, that has the names).
//
// Each type has three functions. `write` writes a value where one is expected: after a key, or as
// an item. `put_schema` adds keywords to the open object of a schema. `read` reads a
// yaml::JsonValue; what cannot be read has none.

namespace cbc::json {

/// For documents that need nothing but what they describe.
struct NoContext {};

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
  void add_text(std::string_view name, const std::string& text);

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
  template <typename Context>
  void write(JsonWriter& json, std::same_as<bool> auto value, const Context& /*context*/) const {
    json.put(value);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write("type", "boolean");
  }
  template <typename Context>
  void read(const auto& json, bool& value, const Context& /*context*/) const {
    value = json.truth();
  }
};
inline constexpr Boolean boolean;

/// Always the same value. Members of this type are there only if it is the value.
template <typename Value>
struct Constant {
  Value constant;

  [[nodiscard]] bool has(const Value& value) const { return value == constant; }
  template <typename Context>
  void write(JsonWriter& json, const auto& /*value*/, const Context& /*context*/) const {
    json.put(constant);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write("const", constant);
  }
  template <typename Context>
  void read(const auto& json, bool& value, const Context& /*context*/) const {
    value = json.truth();
  }
};
inline constexpr Constant<bool> always_true{true};
inline constexpr Constant<bool> always_false{false};

struct Null {
  template <typename Context>
  void write(JsonWriter& json, const auto& /*value*/, const Context& /*context*/) const {
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

  template <std::integral Number, typename Context>
  void write(JsonWriter& json, Number value, const Context& /*context*/) const {
    static_assert(!std::same_as<Number, bool>);
    json.put(value);
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write_members({{"type", "integer"}, {"minimum", least}});
    if (most != any) json.write("maximum", most);
  }
  template <std::integral Number, typename Context>
  void read(const auto& json, Number& value, const Context& /*context*/) const {
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

  template <typename Context>
  void write(JsonWriter& json, const auto& value, const Context& /*context*/) const {
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

  template <typename Context>
  void write(JsonWriter& json, std::string_view value, const Context& /*context*/) const {
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
  template <typename Context>
  void read(const auto& json, std::string& value, const Context& /*context*/) const {
    value = json.text();
  }
  /// As the name of a member.
  template <typename Context>
  [[nodiscard]] std::string_view text(std::string_view key, const Context& /*context*/) const {
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

  template <typename Context>
  void write(JsonWriter& json, Enum value, const Context& /*context*/) const {
    json.put(std::string_view(name_of(value)));
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.open("enum", '[');
    for (int value = 0; value <= static_cast<int>(last); ++value) {
      json.write(std::string_view(name_of(static_cast<Enum>(value))));
    }
    json.close(']');
  }
  template <typename Context>
  void read(const auto& json, Enum& value, const Context& /*context*/) const {
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

  template <typename Context>
  void write(JsonWriter& json, Enum value, const Context& /*context*/) const {
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

  template <typename Context>
  void write(JsonWriter& json, std::integral auto place, const Context& /*context*/) const {
    json.put(list.at(static_cast<std::size_t>(place)));
  }
  void put_schema(JsonWriter& json, Definitions& /*definitions*/) const {
    json.write_list("enum", list);
  }
};

/// An object of any form, given as JSON.
struct FreeObject {
  template <typename Context>
  void write(JsonWriter& json, std::string_view form, const Context& /*context*/) const {
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

  template <typename Context>
  void write(JsonWriter& json, const auto& value, const Context& context) const {
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
  template <typename Value, typename Context>
  void read(const auto& json, std::optional<Value>& value, const Context& context) const {
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

  template <typename Context>
  void write(JsonWriter& json, const auto& value, const Context& context) const {
    type.write(json, value, context);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    definitions.add(name, [&](JsonWriter& part) {
      if (!meaning.empty()) part.write("description", meaning);
      type.put_schema(part, definitions);
    });
    json.write("$ref", "#/$defs/" + std::string(name));
  }
  template <typename Context>
  void read(const auto& json, auto& value, const Context& context) const {
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
  template <typename Context>
  void write(JsonWriter& json, const auto& values, const Context& context) const {
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
  template <typename Value, typename Context>
  void read(const auto& json, std::vector<Value>& values, const Context& context) const {
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
  template <typename Context>
  void write(JsonWriter& json, const auto& values, const Context& context) const {
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
  template <typename Name, typename Value, typename Context>
  void read(const auto& json, std::vector<std::pair<Name, Value>>& values,
            const Context& context) const {
    for (const auto& part : json.members()) {
      auto& [name, value] = values.emplace_back();
      key.read_name(part, name, context);
      type.read(part, value, context);
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

  template <typename Object, typename Context>
  void write(JsonWriter& json, const Object& object, const Context& context) const {
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

// Members.

template <typename Value>
inline constexpr bool is_optional_value = false;
template <typename Value>
inline constexpr bool is_optional_value<std::optional<Value>> = true;

/// A member of an object.
template <bool is_optional, typename Type, typename Projection>
struct Member {
  std::string_view name;
  Type type;
  std::string_view meaning;
  Projection projection;
  bool has_line = false;  ///< it is written on a line of its own

  [[nodiscard]] constexpr Member on_line() const { return {name, type, meaning, projection, true}; }

  template <typename Object, typename Context>
  void write(JsonWriter& json, const Object& object, const Context& context) const {
    decltype(auto) value = project(projection, object, context);
    if constexpr (!is_optional) {
      put(json, value, context);
    } else if constexpr (requires { type.has(value); }) {
      if (type.has(value)) put(json, value, context);
    } else if constexpr (requires { *value; }) {
      if (value) put(json, *value, context);
    } else {
      put(json, value, context);
    }
  }
  void put_property(JsonWriter& json, Definitions& definitions) const {
    json.open(name, '{');
    if (!meaning.empty()) json.write("description", meaning);
    type.put_schema(json, definitions);
    json.close('}');
  }
  void put_required(JsonWriter& json) const {
    if constexpr (!is_optional) json.write(name);
  }
  /// Members that are computed are not read.
  template <typename Object, typename Context>
  void read(const auto& json, Object& object, const Context& context) const {
    if constexpr (requires { type.read(json, project(projection, object, context), context); }) {
      auto& value = project(projection, object, context);
      if constexpr (!is_optional) {
        type.read(json[name], value, context);
      } else if (const auto part = json.find(name)) {
        if constexpr (is_optional_value<std::remove_reference_t<decltype(value)>>) {
          type.read(*part, value.emplace(), context);
        } else {
          type.read(*part, value, context);
        }
      }
    }
  }

 private:
  template <typename Context>
  void put(JsonWriter& json, const auto& value, const Context& context) const {
    if (has_line) json.on_new_line();
    json.key(name);
    type.write(json, value, context);
  }
};
template <typename Type, typename Projection>
[[nodiscard]] constexpr Member<false, Type, Projection> member(std::string_view name, Type type,
                                                               std::string_view meaning,
                                                               Projection projection) {
  return {name, type, meaning, projection};
}
/// Documents may lack it. It is written if the projection, an optional or a pointer, has a value;
/// or if the type says that it is one; of other types always.
template <typename Type, typename Projection>
[[nodiscard]] constexpr Member<true, Type, Projection> optional(std::string_view name, Type type,
                                                                std::string_view meaning,
                                                                Projection projection) {
  return {name, type, meaning, projection};
}

/// The member that names the schema: cbc.lint/1.
[[nodiscard]] constexpr auto schema_member(std::string_view name) {
  return member("schema", Constant<std::string_view>{name}, "Name and version of this format.",
                [](const auto&) { return true; });
}

/// Members in their order; they stand for themselves where members are listed.
template <typename... Members>
struct Group {
  std::tuple<Members...> members;

  template <typename Object, typename Context>
  void write(JsonWriter& json, const Object& object, const Context& context) const {
    std::apply([&](const auto&... member) { (member.write(json, object, context), ...); }, members);
  }
  void put_property(JsonWriter& json, Definitions& definitions) const {
    std::apply([&](const auto&... member) { (member.put_property(json, definitions), ...); },
               members);
  }
  void put_required(JsonWriter& json) const {
    std::apply([&](const auto&... member) { (member.put_required(json), ...); }, members);
  }
  template <typename Object, typename Context>
  void read(const auto& json, Object& object, const Context& context) const {
    std::apply([&](const auto&... member) { (member.read(json, object, context), ...); }, members);
  }
};
template <typename... Members>
[[nodiscard]] constexpr Group<Members...> group(Members... members) {
  return {{members...}};
}

/// The members of a part, as members of the whole.
template <typename Projection, typename Members>
struct Part {
  Projection projection;
  Members members;

  template <typename Object, typename Context>
  void write(JsonWriter& json, const Object& object, const Context& context) const {
    members.write(json, project(projection, object, context), context);
  }
  void put_property(JsonWriter& json, Definitions& definitions) const {
    members.put_property(json, definitions);
  }
  void put_required(JsonWriter& json) const { members.put_required(json); }
  template <typename Object, typename Context>
  void read(const auto& json, Object& object, const Context& context) const {
    if constexpr (std::is_lvalue_reference_v<decltype(project(projection, object, context))>) {
      members.read(json, project(projection, object, context), context);
    }
  }
};
template <typename Projection, typename Members>
[[nodiscard]] constexpr Part<Projection, Members> part(Projection projection, Members members) {
  return {projection, members};
}

/// A member that is in no schema: only our own page reads it.
template <typename Member>
struct Unlisted : Member {
  void put_property(JsonWriter& /*json*/, Definitions& /*definitions*/) const {}
};
template <typename Member>
[[nodiscard]] constexpr Unlisted<Member> unlisted(Member member) {
  return {member};
}

/// An optional member that the schema demands all the same.
template <typename Member>
struct Required : Member {
  void put_required(JsonWriter& json) const { json.write(Member::name); }
};
template <typename Member>
[[nodiscard]] constexpr Required<Member> required(Member member) {
  return {member};
}

/// Adds what an object with these members has.
template <typename Members>
void put_members(JsonWriter& json, Definitions& definitions, const Members& members) {
  json.open("properties", '{');
  members.put_property(json, definitions);
  json.close('}');
  json.open("required", '[');
  members.put_required(json);
  json.close(']');
}

// Objects.

template <typename Members>
struct Object {
  std::string_view name;  ///< of its definition; empty: it is described where it is used
  std::string_view meaning;
  Members members;
  /// What holds between members: schemas as a JSON array, which are all true of it.
  std::string_view relations = {};

  [[nodiscard]] constexpr Object related(std::string_view schemas) const {
    return {name, meaning, members, schemas};
  }

  template <typename Value, typename Context>
  void write(JsonWriter& json, const Value& value, const Context& context) const {
    json.begin('{');
    members.write(json, value, context);
    json.close('}');
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    if (name.empty()) return put_definition(json, definitions);
    definitions.add(name, [&](JsonWriter& part) { put_definition(part, definitions); });
    json.write("$ref", "#/$defs/" + std::string(name));
  }
  void put_definition(JsonWriter& json, Definitions& definitions) const {
    if (!meaning.empty()) json.write("description", meaning);
    json.write("type", "object");
    put_members(json, definitions, members);
    json.write("additionalProperties", false);
    if (!relations.empty()) json.write_json("allOf", relations);
  }
  template <typename Value, typename Context>
  void read(const auto& json, Value& value, const Context& context) const {
    members.read(json, value, context);
  }
};
template <typename... Members>
[[nodiscard]] constexpr Object<Group<Members...>> object(std::string_view name,
                                                         std::string_view meaning,
                                                         Members... members) {
  return {name, meaning, group(members...)};
}

struct Always {
  bool operator()(const auto& /*value*/) const { return true; }
};

/// The members of objects of a few kinds.
template <typename Kind, std::size_t size, typename Members, typename Condition>
struct Variant {
  std::array<Kind, size> kinds;
  std::string_view meaning;
  Members members;
  Condition condition;  ///< of objects of these kinds, where they may have other members as well

  template <typename Other>
  [[nodiscard]] constexpr Variant<Kind, size, Members, Other> where(Other other) const {
    return {kinds, meaning, members, other};
  }

  [[nodiscard]] bool has(Kind kind) const {
    for (const Kind known : kinds) {
      if (known == kind) return true;
    }
    return false;
  }
  /// A variant is part of an object, of which it has the kind and its own members.
  void put_property(JsonWriter& json, Definitions& definitions, std::string_view key) const {
    json.open(key, '{');
    json.open("enum", '[');
    for (const Kind kind : kinds) json.write(std::string_view(name_of(kind)));
    json.close(']');
    json.close('}');
    members.put_property(json, definitions);
  }
};
template <typename Kind, std::size_t size, typename... Members>
[[nodiscard]] constexpr auto variant(const Kind (&kinds)[size], std::string_view meaning,
                                     Members... members) {
  return Variant<Kind, size, Group<Members...>, Always>{std::to_array(kinds), meaning,
                                                        group(members...), Always()};
}

/// Objects that have a kind, on which their members depend: those of the head, the kind, those of
/// its variant, and those of the tail.
template <typename Projection, typename Head, typename Tail, typename... Variants>
struct Union {
  std::string_view name;
  std::string_view meaning;
  std::string_view key;  ///< the member that has the kind
  Projection kind_of;
  Head head;
  Tail tail;
  std::tuple<Variants...> variants;
  std::string_view relations = {};  ///< see Object

  [[nodiscard]] constexpr Union related(std::string_view schemas) const {
    return {name, meaning, key, kind_of, head, tail, variants, schemas};
  }

  template <typename Value, typename Context>
  void write(JsonWriter& json, const Value& value, const Context& context) const {
    const auto kind = project(kind_of, value, context);
    const auto write_variant = [&](const auto& variant) {
      if (!variant.has(kind) || !project(variant.condition, value, context)) return false;
      variant.members.write(json, value, context);
      return true;
    };
    json.begin('{');
    head.write(json, value, context);
    json.key(key);
    json.put(std::string_view(name_of(kind)));
    std::apply([&](const auto&... variant) { (write_variant(variant) || ...); }, variants);
    tail.write(json, value, context);
    json.close('}');
  }
  template <typename Value, typename Context>
  void read(const auto& json, Value& value, const Context& context) const {
    const auto part = json[key];
    const std::string word = part.text();
    const auto read_variant = [&](const auto& variant) {
      for (const auto kind : variant.kinds) {
        if (name_of(kind) != word) continue;
        project(kind_of, value, context) = kind;
        variant.members.read(json, value, context);
        return true;
      }
      return false;
    };
    const bool is_known = std::apply(
        [&](const auto&... variant) { return (read_variant(variant) || ...); }, variants);
    if (!is_known) part.refuse_word(word);
    head.read(json, value, context);
    tail.read(json, value, context);
  }
  void put_schema(JsonWriter& json, Definitions& definitions) const {
    definitions.add(name, [&](JsonWriter& part) { put_definition(part, definitions); });
    json.write("$ref", "#/$defs/" + std::string(name));
  }
  void put_definition(JsonWriter& json, Definitions& definitions) const {
    if (!meaning.empty()) json.write("description", meaning);
    json.write("type", "object");
    json.open("oneOf", '[');
    std::apply([&](const auto&... variant) { (put_variant(json, definitions, variant), ...); },
               variants);
    json.close(']');
    if (!relations.empty()) json.write_json("allOf", relations);
  }

 private:
  /// What all kinds have stands once.
  void put_variant(JsonWriter& json, Definitions& definitions, const auto& variant) const {
    const std::string shared = std::string(name) + "_of_any_kind";
    definitions.add(shared, [&](JsonWriter& part) {
      part.write("type", "object");
      put_members(part, definitions, group(head, tail));
    });
    json.open('{');
    if (!variant.meaning.empty()) json.write("description", variant.meaning);
    json.write("$ref", "#/$defs/" + shared);
    json.write("type", "object");
    json.open("properties", '{');
    variant.put_property(json, definitions, key);
    json.close('}');
    json.open("required", '[');
    json.write(key);
    variant.members.put_required(json);
    json.close(']');
    json.write("unevaluatedProperties", false);
    json.close('}');
  }
};
template <typename Projection, typename Head, typename Tail, typename... Variants>
[[nodiscard]] constexpr Union<Projection, Head, Tail, Variants...> variants(
    std::string_view name, std::string_view meaning, Head head, std::string_view key,
    Projection kind_of, Tail tail, Variants... variants) {
  return {name, meaning, key, kind_of, head, tail, {variants...}};
}

/// Objects of which some are ruled out where they are used. `properties` is JSON.
template <typename Type>
struct Restricted {
  Type type;
  std::string_view properties;

  template <typename Context>
  void write(JsonWriter& json, const auto& value, const Context& context) const {
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

  template <typename Context>
  void write(JsonWriter& json, const auto& value, const Context& context) const {
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

  template <typename Context>
  void write(JsonWriter& json, const auto& value, const Context& context) const {
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

// Documents.

/// A document on a line of its own, unless parts of it are on lines of their own.
template <typename Description, typename Value, typename Context = NoContext>
[[nodiscard]] std::string document(const Description& description, const Value& value,
                                   const Context& context = {},
                                   JsonWriter::Layout layout = JsonWriter::Layout::line) {
  std::string line;
  JsonWriter json(line, layout);
  description.write(json, value, context);
  return line + "\n";
}

/// A JSON Schema from its parts: JSON of an object, and of the definitions.
[[nodiscard]] std::string make_schema(std::string_view name, std::string_view title,
                                      std::string_view whole, const Definitions& definitions);

/// The JSON Schema of a document: the content of schemas/NAME.json.
template <typename Description>
[[nodiscard]] std::string schema(std::string_view name, std::string_view title,
                                 const Description& description) {
  Definitions definitions;
  std::string whole;
  JsonWriter json(whole);
  json.open('{');
  description.put_schema(json, definitions);
  json.close('}');
  return make_schema(name, title, whole, definitions);
}

}  // namespace cbc::json
