#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/support/json.h"
#include "core/support/json_types.h"

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

namespace cbc::json {

/// For documents that need nothing but what they describe.
struct NoContext {};

/// The places of a list whose items are described by their place. (Clang 14 cannot compile
/// std::views::iota of GCC 12.)
template <typename Place>
constexpr auto places_below(Place end) {
  return [end](const auto& put) {
    for (Place place = 0; place < end; ++place) put(place);
  };
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

  template <typename Object>
  void write(JsonWriter& json, const Object& object, const auto& context) const {
    // NOLINTNEXTLINE(readability-qualified-auto): a pointer in some of its uses
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
  template <typename Object>
  void read(const auto& json, Object& object, const auto& context) const {
    using Field = decltype(project(projection, object, context));
    if constexpr (is_optional && is_optional_value<std::remove_reference_t<Field>> &&
                  std::is_lvalue_reference_v<Field>) {
      auto& value = project(projection, object, context);
      value.reset();
      if (const auto part = json.find(name)) type.read(*part, value.emplace(), context);
    } else if constexpr (requires { type.read(json, std::declval<Field>(), context); }) {
      auto& value = project(projection, object, context);
      if constexpr (is_optional) {
        if (const auto part = json.find(name)) type.read(*part, value, context);
      } else {
        type.read(json[name], value, context);
      }
    }
  }

 private:
  void put(JsonWriter& json, const auto& value, const auto& context) const {
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

/// A list that an optional member lacks where it is empty.
template <typename Type>
struct IfAny : Type {
  [[nodiscard]] static bool has(const auto& list) { return !list.empty(); }
};
template <typename Type>
[[nodiscard]] constexpr IfAny<Type> if_any(Type type) {
  return {type};
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

  void write(JsonWriter& json, const auto& object, const auto& context) const {
    std::apply([&](const auto&... member) { (member.write(json, object, context), ...); }, members);
  }
  void put_property(JsonWriter& json, Definitions& definitions) const {
    std::apply([&](const auto&... member) { (member.put_property(json, definitions), ...); },
               members);
  }
  void put_required(JsonWriter& json) const {
    std::apply([&](const auto&... member) { (member.put_required(json), ...); }, members);
  }
  template <typename Object>
  void read(const auto& json, Object& object, const auto& context) const {
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

  void write(JsonWriter& json, const auto& object, const auto& context) const {
    members.write(json, project(projection, object, context), context);
  }
  void put_property(JsonWriter& json, Definitions& definitions) const {
    members.put_property(json, definitions);
  }
  void put_required(JsonWriter& json) const { members.put_required(json); }
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

/// Two JSON arrays that are not empty as one; the second one may be missing.
[[nodiscard]] inline std::string joined_lists(std::string_view first, std::string_view second) {
  if (second.empty()) return std::string(first);
  return std::string(first.substr(0, first.rfind(']'))) + "," +
         std::string(second.substr(second.find('[') + 1));
}

template <typename Members>
struct Object {
  std::string_view name;  ///< of its definition; empty: it is described where it is used
  std::string_view meaning;
  Members members;
  /// What holds between members: schemas as a JSON array, which are all true of it.
  std::string_view relations = {};
  std::string_view more_relations = {};

  /// `more`: further ones, where other objects share the first ones.
  [[nodiscard]] constexpr Object related(std::string_view schemas,
                                         std::string_view more = {}) const {
    return {name, meaning, members, schemas, more};
  }

  template <typename Value>
  void write(JsonWriter& json, const Value& value, const auto& context) const {
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
    if (!relations.empty()) json.write_json("allOf", joined_lists(relations, more_relations));
  }
  template <typename Value>
  void read(const auto& json, Value& value, const auto& context) const {
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

  template <typename Value>
  void write(JsonWriter& json, const Value& value, const auto& context) const {
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
