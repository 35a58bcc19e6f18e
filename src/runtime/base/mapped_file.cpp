#include "runtime/base/mapped_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <system_error>

namespace cbc {
namespace {

MappedFile fail(int code) { return {nullptr, {}, std::generic_category().message(code)}; }

}  // namespace

MappedFile map_file(const std::string& path, std::size_t largest) {
  // Opening a pipe that nobody writes to must not block.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0) return fail(errno);
  struct stat status {};
  if (fstat(file.number(), &status) != 0) return fail(errno);
  if (S_ISDIR(status.st_mode)) return fail(EISDIR);
  if (!S_ISREG(status.st_mode)) return {nullptr, {}, "it is not a regular file"};
  if (status.st_size == 0) return copy_to_memory({});

  const auto size = static_cast<std::size_t>(status.st_size);
  // Checked first, as mapping reads the whole file.
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

}  // namespace cbc
