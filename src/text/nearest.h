#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cbc {

/// Suggests known names for unknown ones: the one at the smallest edit distance, where a
/// difference in case, or between '-' and '_', counts little; failing that, the longest one that
/// begins or ends the unknown name, or is begun or ended by it, at a word boundary. Of equally
/// near names the first wins.
///
/// The work of one object is bounded, so that a file full of unknown names stays cheap: when it is
/// used up there are no more suggestions.
class Suggestions {
 public:
  /// `names` are views of texts that must outlive this object.
  explicit Suggestions(std::vector<std::string_view> names) : names_(std::move(names)) {}

  [[nodiscard]] std::optional<std::string_view> nearest(std::string_view name);

 private:
  std::vector<std::string_view> names_;
  std::size_t work_left_ = 100'000'000;
};

/// One search in a few names.
[[nodiscard]] std::optional<std::string_view> nearest(std::string_view name,
                                                      std::span<const std::string_view> names);

/// How a message about an unknown name ends: "; did you mean 'HOVER'?", or nothing.
[[nodiscard]] std::string did_you_mean(std::optional<std::string_view> suggestion);

}  // namespace cbc
