#include "runtime/compiled/compiled_file.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "runtime/base/mapped_file.h"

namespace cbc {
Digest digest_of(std::string_view content) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(content.data(), content.size()));
  return {std::to_array(canonical.digest)};
}

std::string to_hex(const Digest& digest) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest.bytes) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

namespace {

/// Appends arrays, each after its size.
class Bytes {
 public:
  template <typename T>
  void add(std::span<const T> items) {
    static_assert(std::has_unique_object_representations_v<T>);
    add_size(items.size());
    text_.append(reinterpret_cast<const char*>(items.data()), items.size_bytes());
  }
  template <typename T>
  void add(const Rows<T>& rows) {
    add(rows.begin);
    add(rows.items);
  }
  void add_text(std::string_view text) { add(std::span<const char>(text)); }
  void add_size(std::uint64_t size) {
    text_.append(reinterpret_cast<const char*>(&size), sizeof size);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

Digest identity_of(const CompiledCatalog& catalog) {
  Bytes bytes;
  for (const std::string_view name : catalog.task_names) bytes.add_text(name);
  for (const std::string_view name : catalog.behavior_names) bytes.add_text(name);
  bytes.add(catalog.task_ids);
  bytes.add(catalog.behavior_ids);
  // The texts themselves: their ids depend on the path of the source, which is one of the texts.
  for (const TextId text : catalog.behavior_packages) bytes.add_text(catalog.texts[text]);
  bytes.add(catalog.parameters.begin);
  for (const CompiledParameter& parameter : catalog.parameters.items) {
    bytes.add_text(catalog.texts[parameter.name]);
    bytes.add_size(parameter.allowed_is_list);
    bytes.add_size(parameter.allowed_count);
  }
  for (const TextId text : catalog.allowed_values) bytes.add_text(catalog.texts[text]);
  bytes.add(catalog.group_tasks);
  bytes.add(catalog.group_behaviors);
  bytes.add(catalog.tasks);
  bytes.add(catalog.values);
  bytes.add(catalog.behaviors);
  bytes.add(catalog.requirements);
  bytes.add(catalog.requirement_lines);
  bytes.add(catalog.performs);
  bytes.add(catalog.cliques);
  bytes.add(catalog.clique_lines);
  // Catalogs without situation variables keep the digests that they had before there were any.
  if (!catalog.variables.empty()) {
    for (const CompiledVariable& variable : catalog.variables) {
      bytes.add_text(catalog.texts[variable.name]);
      bytes.add_size(variable.is_boolean);
      bytes.add_size(variable.value_count);
    }
    for (const TextId text : catalog.variable_values) bytes.add_text(catalog.texts[text]);
    bytes.add(catalog.fitting_values);
  }
  // Nor do other keys change the digests of catalogs without them.
  if (!catalog.task_rules.empty()) bytes.add(catalog.task_rules);
  if (!catalog.retries.empty()) bytes.add(catalog.retries);
  if (!catalog.limits.empty()) {
    bytes.add(catalog.limits);
    bytes.add(catalog.limited);
  }
  return digest_of(bytes.text());
}

namespace {

CompiledFileResult open(MappedFile memory) {
  if (memory.memory == nullptr) return {std::nullopt, std::move(memory.error)};
  CompiledFileResult result = decode(memory.content);
  if (!result.file) return result;
  result.file->catalog.storage = std::move(memory.memory);
  if (const auto fault = find_fault(result.file->catalog)) {
    return {std::nullopt, "it is damaged: " + *fault};
  }
  result.file->catalog.set_names();
  return result;
}

}  // namespace

CompiledFileResult load_compiled(const std::string& path) {
  return open(map_file(path, largest_compiled_file));
}

CompiledFileResult read_compiled(std::string_view content) { return open(copy_to_memory(content)); }

}  // namespace cbc
