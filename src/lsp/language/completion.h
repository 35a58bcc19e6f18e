#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/files/recognition.h"
#include "lsp/language/context.h"

namespace cbc::lsp {

/// Something that may be written at a place.
struct Completion {
  enum class Kind : std::uint8_t { key, task, behavior, variable, value, snippet };
  Kind kind = Kind::key;
  std::string label;
  std::string detail;         ///< a few words
  std::string documentation;  ///< plain text
  std::string insert;       ///< in place of the scalar at the cursor, with quotes if it needs them
  bool is_snippet = false;  ///< `insert` has placeholders of LSP: ${1:NAME}
};

/// What may be written at a place, whatever stands there so far: keys that the mapping does not
/// have yet, names, values, and snippets for whole entries. Without a catalog there are no names.
[[nodiscard]] std::vector<Completion> complete(const Context& context, cli::FileKind kind,
                                               const Catalog* catalog);

}  // namespace cbc::lsp
