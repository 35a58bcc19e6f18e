#include "compiled/identity.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace cbc {
namespace {

/// Puts arrays one behind the other, each behind its size.
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
  // By what they say: their places depend on the path of the source, which stands among them.
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
  return digest_of(bytes.text());
}

}  // namespace cbc
