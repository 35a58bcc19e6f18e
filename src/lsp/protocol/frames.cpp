#include "lsp/protocol/frames.h"

#include <array>
#include <charconv>

#include <fmt/core.h>

namespace cbc::lsp {
namespace {

constexpr std::size_t longest_header = 4096;

/// Without its line break; empty at the end of the stream, or if it is too long.
std::optional<std::string> read_header(std::FILE* stream) {
  std::string line;
  for (int byte = std::fgetc(stream); byte != EOF; byte = std::fgetc(stream)) {
    if (byte == '\n') {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      return line;
    }
    if (line.size() == longest_header) break;
    line += static_cast<char>(byte);
  }
  return std::nullopt;
}

std::optional<std::size_t> length_in(std::string_view header) {
  constexpr std::string_view name = "content-length:";
  if (header.size() < name.size()) return std::nullopt;
  for (std::size_t at = 0; at < name.size(); ++at) {
    const char byte = header[at];
    const char lower = byte >= 'A' && byte <= 'Z' ? static_cast<char>(byte + 32) : byte;
    if (lower != name[at]) return std::nullopt;
  }
  header.remove_prefix(name.size());
  while (!header.empty() && header.front() == ' ') header.remove_prefix(1);
  std::size_t length = 0;
  const auto [end, error] = std::from_chars(header.data(), header.data() + header.size(), length);
  if (error != std::errc() || end != header.data() + header.size()) return std::nullopt;
  return length;
}

}  // namespace

std::optional<std::string> read_message(std::FILE* stream) {
  std::optional<std::size_t> length;
  for (;;) {
    const std::optional<std::string> header = read_header(stream);
    if (!header) return std::nullopt;
    if (header->empty()) break;
    if (const auto found = length_in(*header)) length = found;
  }
  if (!length || *length > largest_message) return std::nullopt;
  std::string message;
  std::array<char, 1 << 16> block{};
  while (message.size() < *length) {
    const std::size_t wanted = std::min(block.size(), *length - message.size());
    const std::size_t count = std::fread(block.data(), 1, wanted, stream);
    if (count == 0) return std::nullopt;
    message.append(block.data(), count);
  }
  return message;
}

void MessageWriter::write(std::string_view message) {
  const std::lock_guard lock(mutex_);
  fmt::print(stream_, "Content-Length: {}\r\n\r\n", message.size());
  std::fwrite(message.data(), 1, message.size(), stream_);
  std::fflush(stream_);
}

}  // namespace cbc::lsp
