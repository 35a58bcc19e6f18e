#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <streambuf>
#include <string_view>

namespace cbc::yaml {

/// A text as the input of a scanner that may look ahead without bound.
///
/// yaml-cpp keeps all tokens of a flow collection until it knows whether the collection is a
/// mapping key, so "[[[[..." fills the memory before the first event. This input counts the
/// brackets that were opened and not closed since the last event, and ends a text in which they
/// are far too many. The count knows nothing of quotes and comments, hence the generous bound.
class GuardedInput : public std::streambuf {
 public:
  /// `allowed` is the depth of nesting after which the place of a refusal is reported.
  GuardedInput(std::string_view text, std::size_t allowed) : text_(text), allowed_(allowed) {}

  /// Tells that the scanner got on.
  void reset() { open_ = 0; }

  /// The bracket that was one too many, if the text was cut short.
  [[nodiscard]] std::optional<std::size_t> refused_at() const { return refused_at_; }

 protected:
  int_type underflow() override;

 private:
  [[nodiscard]] bool accept(std::string_view chunk);

  std::string_view text_;
  std::size_t allowed_;
  std::size_t next_ = 0;
  std::size_t open_ = 0;
  std::size_t suspect_ = 0;  // offset at which `open_` last passed `allowed_`
  std::optional<std::size_t> refused_at_;
  std::array<char, 2048> buffer_{};
};

}  // namespace cbc::yaml
