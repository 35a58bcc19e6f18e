#include "compiled/compiled_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#define XXH_INLINE_ALL
#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <xxhash.h>

namespace cbc {
namespace {

MappedFile fail(int code) { return {nullptr, {}, std::generic_category().message(code)}; }

}  // namespace

MappedFile map_file(const std::string& path, std::size_t largest) {
  // A pipe without a writer must not block.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0) return fail(errno);
  struct stat status {};
  if (fstat(file.number(), &status) != 0) return fail(errno);
  if (S_ISDIR(status.st_mode)) return fail(EISDIR);
  if (!S_ISREG(status.st_mode)) return {nullptr, {}, "it is not a regular file"};
  if (status.st_size == 0) return copy_to_memory({});

  const auto size = static_cast<std::size_t>(status.st_size);
  // Asked before all of it is read, which mapping does.
  if (size > largest) {
    return {nullptr, {}, "it is larger than " + std::to_string(largest >> 20) + " MiB"};
  }
  void* const begin = mmap(nullptr, size, PROT_READ, MAP_PRIVATE | MAP_POPULATE, file.number(), 0);
  if (begin == MAP_FAILED) return fail(errno);
  MappedFile mapped;
  mapped.memory = std::shared_ptr<const void>(begin, [size](const void* memory) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): it was not const when it was mapped
    munmap(const_cast<void*>(memory), size);
  });
  mapped.content = {static_cast<const char*>(begin), size};
  return mapped;
}

MappedFile copy_to_memory(std::string_view content) {
  struct alignas(16) Block {
    char bytes[16];
  };
  const std::shared_ptr<Block[]> blocks(new Block[content.size() / sizeof(Block) + 1]);
  char* const begin = blocks[0].bytes;
  std::copy(content.begin(), content.end(), begin);
  MappedFile copy;
  copy.memory = blocks;
  copy.content = {begin, content.size()};
  return copy;
}

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

namespace {

CompiledFileResult open(MappedFile memory) {
  if (memory.memory == nullptr) return {std::nullopt, std::move(memory.error)};
  CompiledFileResult result = decode(memory.content);
  if (!result.file) return result;
  result.file->catalog.storage = std::move(memory.memory);
  if (const auto fault = find_fault(result.file->catalog)) {
    return {std::nullopt, "it is damaged: " + *fault};
  }
  return result;
}

}  // namespace

CompiledFileResult load_compiled(const std::string& path) {
  return open(map_file(path, largest_compiled_file));
}

CompiledFileResult read_compiled(std::string_view content) { return open(copy_to_memory(content)); }

}  // namespace cbc
