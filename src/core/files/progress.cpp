#include "core/files/progress.h"

#include <cstdio>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "core/files/terminal.h"
#include "runtime/base/text.h"

namespace cbc::cli {

namespace {

/// A longer line would wrap, and its first part could not be removed.
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

bool Progress::is_due() const {
  constexpr std::chrono::milliseconds between_updates(100);  // nobody can read faster
  const auto now = std::chrono::steady_clock::now();
  return is_wanted_ && now - start_ >= std::chrono::seconds(1) &&
         (!is_shown_ || now - shown_ >= between_updates);
}

decltype(Budget::tell) Progress::listener() {
  return [this](const std::string& what, const std::function<std::string()>& how_far) {
    const std::lock_guard lock(listening_);
    if (name_ != what) begin(what);
    if (is_due()) show(how_far());
  };
}

void Progress::show(const std::string& detail) {
  if (!is_due()) return;
  // Overwrites the line: carriage return, text, erase to the end.
  const std::string line =
      fmt::format("{} {} of {}: {}{}", what_, begun_, total_, printable(name_), detail);
  fmt::print(stderr, "\r{}\x1b[K", first_characters(line, columns_of(stderr) - 1));
  std::fflush(stderr);
  is_shown_ = true;
  shown_ = std::chrono::steady_clock::now();
}

void Progress::clear() {
  if (!is_shown_) return;
  fmt::print(stderr, "\r\x1b[K");
  is_shown_ = false;
}

}  // namespace cbc::cli
