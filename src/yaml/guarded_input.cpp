#include "yaml/guarded_input.h"

#include <algorithm>

namespace cbc::yaml {
namespace {

constexpr std::size_t bound = 10'000;

}  // namespace

bool GuardedInput::accept(std::string_view chunk) {
  for (std::size_t i = 0; i < chunk.size(); ++i) {
    const char byte = chunk[i];
    if (byte == '[' || byte == '{') {
      ++open_;
      if (open_ == allowed_ + 1) suspect_ = next_ + i;
    } else if ((byte == ']' || byte == '}') && open_ > 0) {
      --open_;
    }
  }
  return open_ <= bound;
}

GuardedInput::int_type GuardedInput::underflow() {
  const std::string_view chunk = text_.substr(next_, buffer_.size());
  if (chunk.empty() || refused_at_) return traits_type::eof();
  if (!accept(chunk)) {
    refused_at_ = suspect_;
    return traits_type::eof();
  }
  std::copy(chunk.begin(), chunk.end(), buffer_.begin());
  next_ += chunk.size();
  setg(buffer_.data(), buffer_.data(), buffer_.data() + chunk.size());
  return traits_type::to_int_type(buffer_.front());
}

}  // namespace cbc::yaml
