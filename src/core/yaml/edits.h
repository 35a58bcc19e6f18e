#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/yaml/source.h"

namespace cbc::yaml {

/// A piece of a text, and what comes in its place.
struct TextEdit {
  Span span;
  std::string_view text;
};

/// Makes edits, which do not overlap and are in the order of the text. All other bytes stay as they
/// are: comments, layout, line breaks.
[[nodiscard]] inline std::string apply_edits(std::string_view text,
                                             std::span<const TextEdit> edits) {
  std::string result;
  std::size_t copied = 0;
  for (const TextEdit& edit : edits) {
    result += text.substr(copied, edit.span.begin - copied);
    result += edit.text;
    copied = edit.span.end;
  }
  result += text.substr(copied);
  return result;
}

}  // namespace cbc::yaml
