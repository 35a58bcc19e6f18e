#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <unistd.h>

/// Files of the operating system: descriptors that close themselves, and files mapped into memory.
namespace cbc {

/// An open file, closed by the destructor; or none.
class Descriptor {
 public:
  Descriptor() = default;
  /// Takes ownership of the file; a negative number means none.
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  void set(int number) {
    close();
    number_ = number;
  }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_ = -1;
};

/// The content of a file in memory, or why there is none ("No such file or directory").
struct MappedFile {
  std::shared_ptr<const void> memory;  ///< owns the content; null after an error
  std::string_view content;            ///< aligned to 16 bytes
  std::string error;
};

/// Maps a regular file of at most `largest` bytes into memory, read-only.
[[nodiscard]] MappedFile map_file(const std::string& path, std::size_t largest);

/// Copies a content into memory.
[[nodiscard]] MappedFile copy_to_memory(std::string_view content);

}  // namespace cbc
