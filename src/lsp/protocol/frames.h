#pragma once

#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

// Messages on a stream, each behind its length: "Content-Length: N\r\n\r\n" and N bytes.

namespace cbc::lsp {

/// Larger messages end the connection, so that none eats the memory of the machine.
inline constexpr std::size_t largest_message = std::size_t{256} << 20U;

/// The next message; empty at the end of the stream, or if it is no message: then nothing that
/// follows can be understood.
[[nodiscard]] std::optional<std::string> read_message(std::FILE* stream);

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
