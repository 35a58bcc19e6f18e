#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string_view>

namespace cbc {

/// A C stream that writes to memory.
class MemoryFile {
 public:
  MemoryFile() : file_(open_memstream(&data_, &size_)) {
    if (file_ == nullptr) throw std::bad_alloc();
  }
  ~MemoryFile() {
    std::fclose(file_);
    std::free(data_);  // NOLINT(cppcoreguidelines-no-malloc): open_memstream wants it
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::FILE* stream() { return file_; }
  /// How much was written so far.
  [[nodiscard]] std::size_t size() { return static_cast<std::size_t>(std::ftell(file_)); }
  /// What was written so far; valid until the next write.
  [[nodiscard]] std::string_view text() {
    if (std::fflush(file_) != 0 || std::ferror(file_) != 0) throw std::bad_alloc();
    return {data_, size_};
  }

 private:
  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* const file_;
};

}  // namespace cbc
