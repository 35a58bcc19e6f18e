#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "cbc/diagnostic.h"
#include "text/position_map.h"
#include "text/style.h"

namespace cbc {

/// The texts that findings are about, by file name.
class SourceTexts {
 public:
  /// `text` must outlive this object. The first text of a name counts.
  void add(std::string file, std::string_view text);

  /// See PositionMap::excerpt; empty if the file or the line is not known.
  [[nodiscard]] PositionMap::Excerpt excerpt(std::string_view file, const Position& place,
                                             std::size_t radius) const;

 private:
  std::map<std::string, PositionMap, std::less<>> texts_;
};

/// A finding as a person reads it, each line of it ended by a line break:
///
///     a.yaml:3:9: error: task 'HOVR' is not defined; did you mean 'HOVER'? [undefined-task]
///       task: HOVR
///             ^~~~
///
/// and then its notes in the same way. Lines that are not known are left out; control characters
/// are made harmless.
[[nodiscard]] std::string render(const Diagnostic& diagnostic, const SourceTexts& sources,
                                 const Style& style);

}  // namespace cbc
