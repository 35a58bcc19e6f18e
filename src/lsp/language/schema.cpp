#include "lsp/language/schema.h"

#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "core/command_line/command_line.h"
#include "schema_files.h"

namespace cbc::lsp {
namespace {

using SchemaJson = nlohmann::ordered_json;
using cli::FileKind;

/// Null if there is none.
const SchemaJson* schema_of(FileKind kind) {
  static const std::map<FileKind, SchemaJson> schemas = [] {
    const std::map<std::string_view, FileKind> kinds = {{"catalog", FileKind::catalog},
                                                        {"script", FileKind::script},
                                                        {"properties", FileKind::properties},
                                                        {"settings", FileKind::settings}};
    std::map<FileKind, SchemaJson> parsed;
    for (const cli::EmbeddedFile& file : cli::schema_files) {
      const auto found = kinds.find(file.name);
      if (found != kinds.end()) parsed.emplace(found->second, SchemaJson::parse(file.text));
    }
    return parsed;
  }();
  const auto found = schemas.find(kind);
  return found == schemas.end() ? nullptr : &found->second;
}

std::string text_in(const SchemaJson& part, const char* key) {
  const auto found = part.find(key);
  return found != part.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

SchemaPlace::SchemaPlace(FileKind kind) : root_(schema_of(kind)) {
  if (root_ != nullptr) add(*root_);
}

SchemaPlace::SchemaPlace(FileKind kind, const std::vector<std::string>& path) : SchemaPlace(kind) {
  for (const std::string& step : path) *this = at(step);
}

// Conditions (not, if, then) describe no place: what they name stands in `properties`, too.
void SchemaPlace::add(const SchemaJson& part) {
  if (!part.is_object() || std::find(parts_.begin(), parts_.end(), &part) != parts_.end()) return;
  parts_.push_back(&part);
  add(resolve(part));
  for (const char* const alternatives : {"anyOf", "oneOf", "allOf"}) {
    const auto found = part.find(alternatives);
    if (found == part.end()) continue;
    for (const SchemaJson& alternative : *found) add(alternative);
  }
}

SchemaPlace SchemaPlace::at(std::string_view step) const {
  SchemaPlace place;
  place.root_ = root_;
  for (const SchemaJson* const part : parts_) {
    const auto own = part->find(step.empty() ? "items" : "properties");
    const bool is_known = own != part->end() && (step.empty() || own->contains(step));
    const auto others = part->find("additionalProperties");
    if (is_known) {
      place.add(step.empty() ? *own : own->at(std::string(step)));
    } else if (!step.empty() && others != part->end()) {
      place.add(*others);
    }
  }
  return place;
}

bool SchemaPlace::has_list() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const SchemaJson* part) { return part->contains("items"); });
}

std::vector<SchemaKey> SchemaPlace::keys() const {
  std::vector<SchemaKey> keys;
  for (const SchemaJson* const part : parts_) {
    const auto properties = part->find("properties");
    if (properties == part->end()) continue;
    const SchemaJson required = part->value("required", SchemaJson::array());
    for (const auto& property : properties->items()) {
      const SchemaPlace place = at(property.key());
      const bool is_older_name =
          std::any_of(place.parts_.begin(), place.parts_.end(),
                      [](const SchemaJson* what) { return what->value("deprecated", false); });
      if (is_older_name) continue;
      const bool is_required =
          std::find(required.begin(), required.end(), property.key()) != required.end();
      keys.push_back({property.key(), place.description(), is_required, is_choice(property.key())});
    }
  }
  return keys;
}

const SchemaJson& SchemaPlace::resolve(const SchemaJson& part) const {
  const std::string pointer = text_in(part, "$ref");
  return pointer.empty() ? part : root_->at(SchemaJson::json_pointer(pointer.substr(1)));
}

// Such keys are required by alternatives, of which exactly one holds.
bool SchemaPlace::is_choice(const std::string& key) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const SchemaJson* part) {
    const SchemaJson choices = part->contains("then")
                                   ? resolve(part->at("then")).value("oneOf", SchemaJson())
                                   : SchemaJson();
    return std::any_of(choices.begin(), choices.end(), [&](const SchemaJson& choice) {
      const SchemaJson required = resolve(choice).value("required", SchemaJson::array());
      return std::find(required.begin(), required.end(), key) != required.end();
    });
  });
}

std::vector<std::string> SchemaPlace::words() const {
  std::vector<std::string> words;
  for (const SchemaJson* const part : parts_) {
    const auto choices = part->find("enum");
    if (choices != part->end()) {
      for (const SchemaJson& word : *choices) {
        if (word.is_string()) words.push_back(word.get<std::string>());
      }
    }
    if (const std::string word = text_in(*part, "const"); !word.empty()) words.push_back(word);
    if (text_in(*part, "title") == "true or false") words.insert(words.end(), {"true", "false"});
  }
  return words;
}

std::string SchemaPlace::description() const {
  for (const SchemaJson* const part : parts_) {
    if (part->contains("description")) return text_in(*part, "description");
  }
  return {};
}

}  // namespace cbc::lsp
