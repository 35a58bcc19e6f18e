#include "lsp/protocol/frames.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <unistd.h>

#include <fmt/core.h>

namespace cbc::lsp {
namespace {

constexpr std::size_t longest_header = 4096;

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

bool MessageReader::fill() {
  if (begin_ < end_) return true;
  ssize_t count = 0;
  do {
    count = ::read(input_, block_.data(), block_.size());
  } while (count < 0 && errno == EINTR);
  begin_ = 0;
  end_ = count > 0 ? static_cast<std::size_t>(count) : 0;
  return count > 0;
}

/// Without its line break; empty at the end of the input, or if it is too long.
std::optional<std::string> MessageReader::read_header() {
  std::string line;
  while (line.size() <= longest_header && fill()) {
    const char byte = block_[begin_++];
    if (byte == '\n') {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      return line;
    }
    line += byte;
  }
  return std::nullopt;
}

std::optional<std::string> MessageReader::next() {
  std::optional<std::size_t> length;
  for (;;) {
    const std::optional<std::string> header = read_header();
    if (!header) return std::nullopt;
    if (header->empty()) break;
    if (const auto found = length_in(*header)) length = found;
  }
  if (!length || *length > largest_message) return std::nullopt;
  std::string message;
  while (message.size() < *length) {
    if (!fill()) return std::nullopt;
    const std::size_t count = std::min(end_ - begin_, *length - message.size());
    message.append(&block_[begin_], count);
    begin_ += count;
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
