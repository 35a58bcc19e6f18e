#include "cli/progress.h"

#include <cstddef>
#include <cstdio>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/terminal.h"
#include "text/quote.h"
#include "text/utf8.h"

namespace cbc::cli {
namespace {

/// A longer line would go on below, and stay.
std::string_view first_characters(std::string_view line, std::size_t count) {
  std::size_t end = 0;
  while (end < line.size() && count-- > 0) end += utf8::decode(line, end).bytes;
  return line.substr(0, end);
}

}  // namespace

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)),
      total_(total),
      is_wanted_(is_terminal(stderr)),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() { clear(); }

void Progress::begin(const std::string& name) {
  ++begun_;
  name_ = name;
  show();
}

void Progress::show(const std::string& detail) {
  constexpr std::chrono::milliseconds between_updates(100);  // more often is no use to anybody
  const auto now = std::chrono::steady_clock::now();
  if (!is_wanted_ || now - start_ < std::chrono::seconds(1)) return;
  if (is_shown_ && now - shown_ < between_updates) return;
  // The line is written over: return, text, erase to the end.
  const std::string line =
      fmt::format("{} {} of {}: {}{}", what_, begun_, total_, printable(name_), detail);
  fmt::print(stderr, "\r{}\x1b[K", first_characters(line, columns_of(stderr) - 1));
  std::fflush(stderr);
  is_shown_ = true;
  shown_ = now;
}

void Progress::clear() {
  if (!is_shown_) return;
  fmt::print(stderr, "\r\x1b[K");
  is_shown_ = false;
}

}  // namespace cbc::cli
