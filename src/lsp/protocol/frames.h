#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

// Messages on a stream, each behind its length: "Content-Length: N\r\n\r\n" and N bytes.

namespace cbc::lsp {

/// Larger messages end the connection, so that none eats the memory of the machine.
inline constexpr std::size_t largest_message = std::size_t{256} << 20U;

/// Reads messages from a file descriptor. A stream of C would not do: its lock is held while a
/// thread waits for input, and a program that ends waits for the locks of all streams.
class MessageReader {
 public:
  explicit MessageReader(int input) : input_(input) {}
  /// The next message; empty at the end, or if it is no message: then nothing that follows can be
  /// understood.
  [[nodiscard]] std::optional<std::string> next();

 private:
  [[nodiscard]] bool fill();
  [[nodiscard]] std::optional<std::string> read_header();

  const int input_;
  std::array<char, 1 << 16> block_{};
  std::size_t begin_ = 0;  ///< of what is left of the block
  std::size_t end_ = 0;
};

/// Writes messages of several threads, each as a whole.
class MessageWriter {
 public:
  explicit MessageWriter(std::FILE* stream) : stream_(stream) {}
  void write(std::string_view message);

 private:
  std::FILE* stream_;
  std::mutex mutex_;
};

}  // namespace cbc::lsp
