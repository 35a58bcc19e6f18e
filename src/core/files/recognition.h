#pragma once

#include <cstdint>
#include <string_view>

#include "core/yaml/document.h"

/// Tells by its content what a file is, also if it cannot be read.
namespace cbc::cli {

enum class FileKind : std::uint8_t {
  catalog,
  compiled,    ///< a compiled catalog
  script,      ///< an event script
  properties,  ///< it has the key `properties` or `assume`
  settings,
  log,  ///< of a stream
  other
};

/// What a file is.
struct Recognition {
  FileKind kind = FileKind::other;
  /// It would be of this kind but for a misspelt key, or because it is not valid YAML.
  bool is_faulty = false;
  /// What is in folders counts only if this is set, as other YAML files have such keys, too.
  bool is_sure = true;

  /// Whether it is of a kind, without such a fault.
  [[nodiscard]] bool is(FileKind what) const { return kind == what && !is_faulty; }
};

/// What a file is, by its content; settings are recognized by their name. `document`: null if the
/// text is not valid YAML.
[[nodiscard]] Recognition recognize(std::string_view name, std::string_view text,
                                    const yaml::Document* document);

}  // namespace cbc::cli
