#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/files/recognition.h"

/// What the language has at a place, by the JSON Schemas of the files that people write.
namespace cbc::lsp {

struct SchemaKey {
  std::string name;
  std::string description;
  bool is_required = false;
  bool is_choice = false;  ///< of several such keys a mapping has one
};

/// What may stand at a place.
class SchemaPlace {
 public:
  /// The root of a kind of file; a kind without a schema has nothing anywhere.
  explicit SchemaPlace(cli::FileKind kind);
  /// The place at the end of a path, as in Context.
  SchemaPlace(cli::FileKind kind, const std::vector<std::string>& path);

  /// The value of a key, or with "" an item of a list.
  [[nodiscard]] SchemaPlace at(std::string_view step) const;

  [[nodiscard]] bool has_list() const;
  /// The keys of the mapping, if there may be one, in the order of the schema; none that are older
  /// names.
  [[nodiscard]] std::vector<SchemaKey> keys() const;
  /// The words that the value may be, and those of a boolean.
  [[nodiscard]] std::vector<std::string> words() const;
  /// What the place is for; empty if the schema does not say.
  [[nodiscard]] std::string description() const;

 private:
  SchemaPlace() = default;
  [[nodiscard]] const nlohmann::ordered_json& resolve(const nlohmann::ordered_json& part) const;
  [[nodiscard]] bool is_choice(const std::string& key) const;
  void add(const nlohmann::ordered_json& part);

  const nlohmann::ordered_json* root_ = nullptr;
  /// All that the place is described by, without references and alternatives: the nearest first.
  std::vector<const nlohmann::ordered_json*> parts_;
};

}  // namespace cbc::lsp
