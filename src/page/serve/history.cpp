#include "page/serve/history.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace cbc::serve {
namespace {

void append_field(std::string& text, std::string_view name, std::string_view value) {
  text.append(name).append(": ").append(value).append("\n");
}

}  // namespace

bool History::wants_state() const {
  // No other thread changes the parts.
  if (parts_.empty()) return true;
  const Part& last = *parts_.back();
  return last.ends.size() >= limits_.messages || last.text.size() >= limits_.bytes;
}

void History::begin_part(std::string_view state) {
  auto part = std::make_shared<Part>();
  part->text.reserve(limits_.bytes);
  part->number = next_part_++;
  part->first_id = next_id_;
  append_field(part->text, "event", "state");
  append_field(part->text, "data", state);
  part->text += '\n';
  const std::lock_guard lock(mutex_);
  parts_.push_back(std::move(part));
  if (parts_.size() > limits_.parts) parts_.pop_front();
}

void History::add(std::string_view type, std::string_view data) {
  const std::lock_guard lock(mutex_);
  Part& part = *parts_.back();
  append_field(part.text, "id", std::to_string(next_id_++));
  if (!type.empty()) append_field(part.text, "event", type);
  append_field(part.text, "data", data);
  part.text += '\n';
  part.ends.push_back(part.text.size());
}

void History::end() {
  const std::lock_guard lock(mutex_);
  is_at_end_ = true;
}

bool History::is_over(const Reader& reader) const {
  const std::lock_guard lock(mutex_);
  return is_at_end_ && (parts_.empty() || (reader.part_ == parts_.back() &&
                                           reader.place_ == reader.part_->text.size()));
}

std::string History::read(Reader& reader, std::size_t most) const {
  const std::lock_guard lock(mutex_);
  if (parts_.empty()) return {};
  if (reader.part_ == nullptr) {
    reader.part_ = parts_.front();
  } else if (reader.place_ == reader.part_->text.size() && reader.part_ != parts_.back()) {
    const std::uint64_t first = parts_.front()->number;
    const std::uint64_t next = std::max(reader.part_->number + 1, first);
    reader.part_ = parts_[static_cast<std::size_t>(next - first)];
    reader.place_ = 0;
  }
  std::string text = reader.part_->text.substr(reader.place_, most);
  reader.place_ += text.size();
  return text;
}

History::Reader History::reader_after(std::string_view id) const {
  Reader reader;
  std::uint64_t number = 0;
  const auto [stop, error] = std::from_chars(id.data(), id.data() + id.size(), number);
  if (error != std::errc() || stop != id.data() + id.size()) return reader;
  const std::lock_guard lock(mutex_);
  for (const auto& part : parts_) {
    if (number < part->first_id || number - part->first_id >= part->ends.size()) continue;
    reader.part_ = part;
    reader.place_ = part->ends[static_cast<std::size_t>(number - part->first_id)];
  }
  return reader;
}

}  // namespace cbc::serve
